#include "solve/exported_visibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "solve/embree_visibility.hpp"
#include "urad/form_factor.hpp"

namespace host {
namespace {

constexpr int kAny = -1;  // a pair that exchanges no light

struct SeenPair {
  std::size_t i, j;
  double exchange, seen;
};

/// Pairs that exchange light, in the order of (i, j).
std::vector<SeenPair> seen_pairs(const Scene& scene, const FixedScene& fixed, int rays,
                                 int threads) {
  const std::size_t n = scene.patches.size();
  std::vector<std::vector<SeenPair>> rows(n);
  const EmbreeVisibility visibility(scene, rays);
  parallel_for(n, threads, [&](std::size_t i) {
    urad_counters unread{};
    const urad::Patch a = urad::patch_at(fixed.pod(), std::uint16_t(i));
    for (std::size_t j = i + 1; j < n; ++j) {
      const urad::Patch b = urad::patch_at(fixed.pod(), std::uint16_t(j));
      const std::int32_t log2_g_q24 =
          urad::exchange_log2_q24(fixed.pod(), a, b, urad::Kernel::moment, nullptr, 0, &unread);
      if (log2_g_q24 == urad::kNoExchange) continue;
      rows[i].push_back({i, j, std::exp2(log2_g_q24 * 0x1p-24), visibility.fraction(i, j)});
    }
  });
  std::vector<SeenPair> pairs;
  for (const std::vector<SeenPair>& row : rows) pairs.insert(pairs.end(), row.begin(), row.end());
  return pairs;
}

/// Nothing or all for pairs seen in part, the greatest exchanges first: what leaves the light that both
/// patches exchange with all others nearest to what it is.
std::vector<int> bits_of(const Scene& scene, const std::vector<SeenPair>& pairs) {
  std::vector<int> codes(pairs.size());
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return pairs[a].exchange > pairs[b].exchange;
  });
  std::vector<double> off(scene.patches.size());
  for (const std::size_t k : order) {
    const auto& [i, j, exchange, seen] = pairs[k];
    const double weight_i = 1 / scene.patches[i].moments.area,
                 weight_j = 1 / scene.patches[j].moments.area;
    const auto error_of = [&, i = i, j = j](double change) {
      const double a = off[i] + change, b = off[j] + change;
      return weight_i * a * a + weight_j * b * b;
    };
    const double shut = -seen * exchange, open = exchange + shut;
    codes[k] = seen == 1 || (seen > 0 && error_of(open) < error_of(shut));
    const double change = codes[k] ? open : shut;
    off[i] += change, off[j] += change;
  }
  return codes;
}

/// All codes, [N][N].
std::vector<std::int8_t> codes_of(const Scene& scene, const FixedScene& fixed, VisibilityCode code,
                                  int rays, int threads) {
  const std::size_t n = scene.patches.size();
  const std::vector<SeenPair> pairs = seen_pairs(scene, fixed, rays, threads);
  std::vector<int> values;
  if (code == VisibilityCode::bits) {
    values = bits_of(scene, pairs);
  } else {
    for (const SeenPair& pair : pairs) values.push_back(int(std::lround(15 * pair.seen)));
  }
  std::vector<std::int8_t> codes(n * n, kAny);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto& [i, j, exchange, seen] = pairs[k];
    codes[i * n + j] = codes[j * n + i] = std::int8_t(values[k]);
  }
  return codes;
}

std::vector<std::uint8_t> plain(const std::int8_t* code, std::size_t count, int bits) {
  std::vector<std::uint8_t> bytes((count * std::size_t(bits) + 7) / 8);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t bit = k * std::size_t(bits);
    bytes[bit / 8] |= std::uint8_t(std::max<int>(code[k], 0) << bit % 8);
  }
  return bytes;
}

std::vector<std::uint8_t> in_runs(const std::int8_t* code, std::size_t count, int bits) {
  const std::size_t longest = std::size_t{1} << (8 - bits);
  std::vector<std::uint8_t> bytes;
  for (std::size_t k = 0; k < count;) {
    int value = kAny;
    std::size_t length = 0;
    for (; k < count && length < longest; ++k, ++length) {
      if (code[k] == kAny || code[k] == value) continue;
      if (value != kAny) break;
      value = code[k];
    }
    bytes.push_back(std::uint8_t(std::max(value, 0) << (8 - bits) | int(length - 1)));
  }
  return bytes;
}

}  // namespace

VisibilityCode parse_visibility_code(const std::string& name) {
  if (name == "bits") return VisibilityCode::bits;
  if (name == "fractions") return VisibilityCode::fractions;
  throw UsageError(fmt::format("--visibility {}: bits or fractions would do", name));
}

VisibilityTables make_visibility(const Scene& scene, const FixedScene& fixed, VisibilityCode code,
                                 int rays, int threads) {
  const std::size_t n = scene.patches.size();
  const std::vector<std::int8_t> codes = codes_of(scene, fixed, code, rays, threads);
  VisibilityTables tables;
  tables.bits = std::uint8_t(code);
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<std::uint8_t> runs = in_runs(&codes[i * n], n, tables.bits),
                                    row = plain(&codes[i * n], n, tables.bits);
    const bool shorter = runs.size() < row.size();
    tables.row.push_back(std::uint32_t(tables.code.size()) | (shorter ? URAD_VISIBILITY_RUNS : 0u));
    const std::vector<std::uint8_t>& bytes = shorter ? runs : row;
    tables.code.insert(tables.code.end(), bytes.begin(), bytes.end());
  }
  return tables;
}

std::string to_line(const VisibilityTables& tables) {
  const auto runs = std::count_if(tables.row.begin(), tables.row.end(),
                                  [](std::uint32_t row) { return row & URAD_VISIBILITY_RUNS; });
  return fmt::format("{} bytes: {} a pair, {} of {} rows in runs", tables.bytes(),
                     tables.bits == 1 ? "1 bit" : "4 bits", runs, tables.row.size());
}

}  // namespace host
