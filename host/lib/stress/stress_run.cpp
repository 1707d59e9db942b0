#include "stress/stress_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/output_folder.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "stress/watch.hpp"

namespace host {
namespace {

constexpr std::uint64_t kFilesPerCheck = 3;
constexpr double kMostSeconds = 120;  // of one case
constexpr std::size_t kProgressSteps = 1000;

double share_of(const std::string& kind) {
  // Where the most can be hidden in the least time.
  if (kind == "files") return 3;
  if (kind == "pairs" || kind == "scenes") return 2;
  return 1;
}

std::uint64_t stream_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

/// The rows of one kind, filled by all threads.
class Tally {
 public:
  Tally(const StressRequest& request, StressReport* report) : request_(request), report_(report) {}

  void add(const StressCase& c, std::uint64_t index, const std::vector<StressCheck>& checks) {
    const std::lock_guard<std::mutex> guard(lock_);
    for (const StressCheck& check : checks) {
      StressRow& row = row_of(c, check);
      ++row.cases;
      row.sum += check.value;
      if (row.cases == 1 || check.value > row.worst) row.worst = check.value, row.where = index;
      if (check.holds()) continue;
      if (row.failures++ < kFilesPerCheck) keep(c, check, index);
    }
  }

 private:
  StressRow& row_of(const StressCase& c, const StressCheck& check) {
    const auto [at, fresh] = known_.try_emplace({c.family, check.what}, report_->rows.size());
    if (fresh) report_->rows.push_back({c.kind, c.family, check.what, 0, 0, 0, check.limit, 0, 0});
    return report_->rows[at->second];
  }

  void keep(const StressCase& c, const StressCheck& check, std::uint64_t index) {
    if (request_.folder.empty()) return;
    std::string name = fmt::format("{}_{}_{}_{}", c.kind, c.family, check.what, index);
    std::replace_if(
        name.begin(), name.end(),
        [](char x) { return !std::isalnum(static_cast<unsigned char>(x)) && x != '_'; }, '-');
    const std::string path =
        (std::filesystem::path(request_.folder) / (name.substr(0, 200) + ".case")).string();
    write_file_atomically(path, to_text(c));
    report_->files.push_back(path);
  }

  const StressRequest& request_;
  StressReport* report_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;
  std::mutex lock_;
};

using Clock = std::chrono::steady_clock;

/// All families of a kind in turn, until `seconds` are over or each has had its cases.
std::uint64_t run_kind(const std::string& kind, double seconds, const StressRequest& request,
                       StressReport* report) {
  const std::vector<Attack> attacks = attacks_of(kind, request.nets);
  const std::size_t threads = thread_count(request.threads);
  const std::uint64_t most = request.cases > 0 ? request.cases * attacks.size() : std::uint64_t(-1);
  CaseWatch watch(request.folder, kMostSeconds, threads);
  Progress progress("stress: " + kind, kProgressSteps, request.quiet);
  Tally tally(request, report);
  std::atomic<std::uint64_t> next{0}, done{0};
  std::atomic<std::size_t> shown{0};
  const auto start = Clock::now();
  const auto part = [&] {
    if (request.cases > 0) return double(done) / double(most);
    return std::chrono::duration<double>(Clock::now() - start).count() / seconds;
  };
  parallel_for(threads, int(threads), [&](std::size_t thread) {
    while (part() < 1) {
      const std::uint64_t number = next++;
      if (number >= most) break;
      const Attack& attack = attacks[number % attacks.size()];
      const StressCase c = stress_case(attack, request.seed, number / attacks.size());
      const std::string text = to_text(c);
      Findings findings;
      watch.begin(thread, text);
      attack.run(c.input, &findings);
      watch.end(thread);
      tally.add(c, number / attacks.size(), findings.checks());
      ++done;
      const auto steps = std::min(kProgressSteps, std::size_t(part() * double(kProgressSteps)));
      const std::size_t before = shown.exchange(std::max(shown.load(), steps));
      if (steps > before) progress.add(steps - before);
    }
  });
  return done;
}

}  // namespace

std::uint64_t StressReport::failures() const {
  std::uint64_t sum = 0;
  for (const StressRow& row : rows) sum += row.failures;
  return sum;
}

StressCase stress_case(const Attack& attack, std::uint64_t seed, std::uint64_t index) {
  Random random(seed ^ stream_of(attack.kind + "/" + attack.family), index);
  return {attack.kind, attack.family, attack.draw(random)};
}

StressReport run_stress(const StressRequest& request) {
  StressReport report;
  report.request = request;
  double shares = 0;
  for (const std::string& kind : request.kinds) shares += share_of(kind);
  std::optional<OutputFolder> folder;
  if (!request.folder.empty()) folder.emplace(request.folder);
  const auto start = Clock::now();
  for (const std::string& kind : request.kinds) {
    const double seconds = 60 * request.minutes * share_of(kind) / shares;
    report.kind_cases.push_back(run_kind(kind, seconds, request, &report));
  }
  report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  std::stable_sort(report.rows.begin(), report.rows.end(),
                   [&](const StressRow& a, const StressRow& b) {
                     return a.kind == b.kind && a.family < b.family;
                   });
  return report;
}

std::vector<StressCheck> replay(const StressCase& c, const NetChoice& nets) {
  for (const Attack& attack : attacks_of(c.kind, nets)) {
    if (attack.family != c.family) continue;
    Findings findings;
    attack.run(c.input, &findings);
    return findings.checks();
  }
  throw Error(fmt::format("{} has no family '{}'", c.kind, c.family));
}

}  // namespace host
