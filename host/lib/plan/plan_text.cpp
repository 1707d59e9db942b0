#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "plan/plan.hpp"
#include "report/text.hpp"

namespace host {

namespace {

std::string limit(std::size_t bytes) {
  return bytes == SIZE_MAX ? "any" : grouped(std::int64_t(bytes));
}

}  // namespace

std::string plan_text(const Plan& plan) {
  std::string text = fmt::format(
      "{}: {} patches, about {:.0f} shots to {}{}; RAM {}, flash {}\n\n{:<16} {:>9} {:>9} {:>9} "
      "{:>12} {:>14} {:>9}  {}\n",
      plan.scene, plan.patches, plan.shots, percent(plan.request.error),
      plan.shots_complete ? "" : " (extrapolated)", limit(plan.request.ram),
      limit(plan.request.flash), "method", "RAM", "data", "code", "per shot", "per solve", "error",
      "");
  for (std::size_t k = 0; k < plan.methods.size(); ++k) {
    const PlannedMethod& m = plan.methods[k];
    std::string remark = plan.recommended == k ? "<- take this" : m.misfit;
    if (!m.setting.empty())
      remark = remark.empty() ? m.setting : fmt::format("{}; {}", m.setting, remark);
    if (m.per_solve == 0) {
      text += fmt::format("{:<16} {:>67}  {}\n", m.method, "", remark);
      continue;
    }
    text += fmt::format("{:<16} {:>9} {:>9} {:>9} {:>12} {:>14} {:>9}  {}\n", m.method,
                        grouped(std::int64_t(m.ram)), grouped(std::int64_t(m.data)),
                        grouped(std::int64_t(m.code)), grouped(std::int64_t(m.per_shot)),
                        grouped(std::int64_t(m.per_solve)), percent(m.error), remark);
  }
  return text + "\nBytes; data and code lie in flash. Instructions of a Cortex-M0.\n" +
         plan.advice + "\n";
}

std::string plan_json(const Plan& plan) {
  nlohmann::ordered_json methods = nlohmann::ordered_json::array();
  for (const PlannedMethod& m : plan.methods) {
    nlohmann::ordered_json line{{"method", m.method}, {"setting", m.setting}, {"fits", m.fits()}};
    if (!m.misfit.empty()) line["why_not"] = m.misfit;
    if (m.per_solve > 0) {
      line["ram_bytes"] = m.ram;
      line["flash_bytes"] = m.flash();
      line["flash_data_bytes"] = m.data;
      line["flash_code_bytes"] = m.code;
      line["instructions_per_shot"] = m.per_shot;
      line["instructions_per_solve"] = m.per_solve;
      line["expected_error"] = m.error;
    }
    methods.push_back(line);
  }
  nlohmann::ordered_json json{
      {"scene", plan.scene},         {"patches", plan.patches},
      {"shots", plan.shots},         {"shots_extrapolated", !plan.shots_complete},
      {"error", plan.request.error}, {"methods", methods}};
  if (plan.request.ram != SIZE_MAX) json["ram"] = plan.request.ram;
  if (plan.request.flash != SIZE_MAX) json["flash"] = plan.request.flash;
  if (plan.recommended) json["recommended"] = *plan.recommended;
  json["advice"] = plan.advice;
  return json.dump(2) + "\n";
}

}  // namespace host
