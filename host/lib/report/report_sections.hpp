// The sections of report.html, in the order of the page. Each is empty when the report has nothing
// to fill it.
#pragma once
#include <string>

#include "report/bake_report.hpp"

namespace host {

std::string summary_html(const BakeReport& report);
std::string pictures_html(const BakeReport& report);
std::string methods_html(const BakeReport& report);
std::string plots_html(const BakeReport& report);
std::string skips_html(const BakeReport& report);
std::string energy_html(const BakeReport& report);
std::string memory_html(const BakeReport& report);
std::string reproduce_html(const BakeReport& report);

}  // namespace host
