// Which methods fit a chip and an error, what each costs, and which to take: before anything runs
// there.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "method/nets.hpp"
#include "scene/scene.hpp"

namespace host {

struct PlanRequest {
  std::size_t ram = SIZE_MAX, flash = SIZE_MAX;  ///< bytes of the chip that a solve may take
  double error = 0.01;                           ///< relative rms of B against the exact solution
  bool visibility = false;  ///< also with exported visibility, which is made for it: some seconds
  int threads = 0;
};

/// One line of a plan. Sizes are those of a 32-bit chip, instructions those of a Cortex-M0.
struct PlannedMethod {
  std::string method;    ///< as `urad solve --method` takes it
  std::string setting;   ///< what else to ask for: a network to train, a band of rows; or empty
  std::size_t ram = 0;   ///< state, light, one run of factors, the source and its memory
  std::size_t data = 0;  ///< flash: scene, network, tables
  std::size_t code = 0;  ///< flash: the engine's functions, linked
  double per_shot = 0;   ///< instructions
  double per_solve = 0;  ///< instructions, until the engine's estimate is the error asked for
  double error = 0;      ///< expected of B, the part of the stop included
  std::string misfit;    ///< why it cannot be taken; empty: it can

  std::size_t flash() const { return data + code; }
  bool fits() const { return misfit.empty(); }
};

struct Plan {
  std::string scene;
  std::size_t patches = 0;
  double shots = 0;
  bool shots_complete = true;  ///< false: extrapolated, the scene is too large to rehearse
  PlanRequest request;
  std::vector<PlannedMethod> methods;      ///< cheapest first, those that fit before the others
  std::optional<std::size_t> recommended;  ///< index
  std::string advice;                      ///< one sentence: the recommendation, or what would do
};

/// Throws Error when the engine cannot take the scene.
Plan make_plan(const Scene& scene, const NetChoice& nets, const PlanRequest& request);

/// A table for a terminal, and the same as JSON.
std::string plan_text(const Plan& plan);
std::string plan_json(const Plan& plan);

}  // namespace host
