#include "accuracy/kernel_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace host {

KernelTrials try_kernels(const KernelTrialRequest& request) {
  constexpr std::uint64_t kSeed = 1;
  const auto share = [&](int whole) {
    return std::max(20, int(std::lround(whole * request.effort)));
  };
  BaseTrialRequest bases;
  bases.effort = std::max(0.01, 0.3 * request.effort);
  bases.threads = request.threads;
  GuessLimitRequest guesses;
  guesses.pairs = std::size_t(share(800));
  guesses.steps = share(8000);
  guesses.net = request.net;
  guesses.threads = request.threads;
  const auto pairs = std::size_t(share(3000));
  return {try_third_moments(kSeed, pairs, request.threads),
          try_third_moments_in_auto(kSeed, pairs, request.net, request.threads), try_bases(bases),
          try_guesses(guesses)};
}

std::string kernel_document(const KernelTrials& trials, const std::string& command) {
  return fmt::format(
      R"(# What was tried instead

Written by `{}`. Ways to a form factor, and to a guess at its error, that the engine does not have,
beside those it has, in one run, and in double where nothing else is said: why it is as it is. Third moments are the one that
was taken over.

## Third moments

T3 is the term of third order in size over distance of the series from which the moment kernel has T2: nothing for a patch with
a centre of symmetry. Pairs wholly in front of each other, |K - exact| / exact.

{}
T3 takes the error of lopsided patches to that of parallelograms. So the guess that auto has for those holds for all, once T3
is in, but for a constant: no guess is added, and T3 is computed after it and only for pairs that pass, where 3/2 of the bends
do not already say that T3 is less than the error asked for. T3 is a mean of a cubic form, which corners give exactly: no moment
is stored, scenes are as they were, and a triangle costs 36 multiply-adds (corners of others 28 each) where four stored moments
would cost 33 and 20 bytes of every polygon.

What auto saves, in the engine's integers: as it is ("three"), and with a kernel that has two moments, its guess
told how lopsided the two are and moved until it holds for 99 % of other pairs. Pairs that are not cut, rho up to 0.35, at least
one of the two no parallelogram; of the first three kinds rho is spread evenly over decades, the others are families of
[METHODS.md](METHODS.md), test pairs, and pairs of a scene. "hold": of the pairs by the kernel.

{}
The kernel of `fixed-moment` and that under the network have no T3: either would pay for it at every pair, which auto need not,
and a network wins little by it (below).

## Other kernels for the network, other inputs

What the network is multiplied with, or reads besides its 14 inputs: T3 / (1 + |T3|), or a quarter of log2 of the sum over
2 x 2 x 2 x 2 pairs of Gauss points by the moment kernel. {} seeds, a training each, the worst is shown; pairs that no training
has seen, none of them cut. Exact sums have their points on the smaller patch; no guess is counted. "-": too few such pairs.

{}
At equal cost: third moments with 4 hidden against the moment kernel with 8, pairs of points with 8 against the moment kernel with
18. T3 lowers the median of free quads, the only family here that has any, and nothing beyond what seeds differ by of p95 and p99. Pairs
of points lower medians where rho is below 0.3; but there the exact sum at 2 x 2 points, for less than half as much again, has a tenth
of the median that they have with a network. Above 0.3, where patches touch, pairs of points see no edge, and with or without a network
they are behind the same sum in every column. So neither is in the engine.

## How well an error can be guessed

Outcomes of auto at five errors asked for, 10 to 0.1 %, on test pairs. In a cell: how many guesses hold, and guess / true error,
median and p90. "moved": what auto says, moved until it holds for 99 % of this kind on pairs of its own, as are all columns to
its right. "a wide network": {} hidden neurons in double, which read all that auto has when it stops. "what touches": which is told
besides how many corners the two share, and how many lie on the other's plane. "the kind": which is told the row it is in. The last two
columns are what errors differ by where all traits and the kind are the same, as far as a network can see: for a normal
distribution of known width, 3.8 and 5.4.

{}
A bound that holds for 99 % of a normal distribution of known width is 3.8 times its median error, and 20 times its p10: that much is
due to errors changing sign. The goal, 5 and 50, leaves a factor of 1.3 and 2.5 for not knowing the width. Pairs that share an edge or a
corner, and walls of a room, which do so too, reach it or nearly, by a network that is told what touches; moving alone halves what auto
says there, since one shift holds for all near pairs. For all other kinds no network does, however wide and whatever it is told: the last
two columns say that errors at equal traits differ by far more than a sign. Their width is set by what lies between points.
)",
      command, third_order_table(trials.third_order), third_order_table(trials.third_order_costs),
      trials.bases.front().all.front().median.size(), base_table(trials.bases),
      GuessLimitRequest{}.hidden, guess_table(trials.guesses));
}

}  // namespace host
