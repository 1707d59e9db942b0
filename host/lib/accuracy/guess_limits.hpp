// How well an error can be guessed from what is known of a pair: what the engine says against what a
// wide network would, were it to say it, and one that is even told the kind of pair.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "urad/net.h"

namespace host {

/// Of pairs on which no guess was fitted: how many guesses hold, and guess / true error.
struct GuessQuality {
  double holds = 0, median = 0, p90 = 0;
};

struct GuessLimit {
  std::string family;
  std::size_t outcomes = 0;
  GuessQuality engine;  ///< what auto says
  GuessQuality moved;   ///< the same, moved until it holds for 99 % of just this family
  GuessQuality wide;    ///< a wide network with all that auto knows, moved alike
  GuessQuality
      corners;  ///< one that is told how many corners the two share or have on the other's plane
  GuessQuality told;    ///< one that is told the family
  double scatter = 0;   ///< p99 of the true error by its median, by what `told` makes of it
  double crossing = 0;  ///< median of the true error by its p10, the same
};

struct GuessLimitRequest {
  std::uint64_t seed = 1;
  std::size_t pairs = 1000;  ///< of each family, thrice
  int hidden = 64;
  int steps = 12000;
  const urad_net* net = nullptr;
  int threads = 0;
};

/// Outcomes of auto at five errors asked for, of the families of trial_pairs.hpp that are fitted on.
std::vector<GuessLimit> try_guesses(const GuessLimitRequest& request);

/// In Markdown.
std::string guess_table(const std::vector<GuessLimit>& limits);

}  // namespace host
