// Errors of form factors against the reference, in one row per group of pairs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "network/pair_kind.hpp"

namespace host {

/// One ordered pair. A pair with exact == 0 counts in the absolute figures only.
struct Measured {
  double exact = 0, value = 0;  ///< F
  PairKind kind = PairKind::middle;
};

struct RowSums {
  double mean = 0, worst = 0;  ///< of |sum - exact sum| / exact sum
};

struct ErrorRow {
  std::string name;
  std::size_t pairs = 0;
  double median = 0, p95 = 0, p99 = 0, max = 0;  ///< relative: |value - exact| / exact
  double std = 0, bias = 0;                      ///< absolute: deviation and mean of value - exact
  std::optional<RowSums> rows;                   ///< where whole rows were measured
};

ErrorRow error_row(const std::string& name, const std::vector<Measured>& pairs);

/// "all", then by decade of exact F ("F < 1e-5" ... "F >= 0.1"), then by kind; empty groups are
/// left out.
std::vector<ErrorRow> error_table(const std::string& name, const std::vector<Measured>& pairs);

/// Aligned text, one line a row under one line of headings.
std::string to_text(const std::vector<ErrorRow>& table);

/// "median .. p99 .. std .. rows .." on one line, for banners and manifests.
std::string to_line(const ErrorRow& row);

}  // namespace host
