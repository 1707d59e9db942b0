#include "legacy/legacy_training.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numeric>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/output_folder.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"

namespace host {

namespace {

namespace fs = std::filesystem;
constexpr auto kBetweenCheckpoints = std::chrono::seconds(5);

std::optional<LegacyNetFile> finished(const std::string& path, const std::string& command) {
  if (!fs::exists(path)) return {};
  try {
    LegacyNetFile file = legacy_from_json(read_file(path), path);
    if (file.command == command) return file;
  } catch (const Error&) {  // not ours: it is trained anew
  }
  return {};
}

BackpropState start_of(const LegacyJob& job, const std::string& partial) {
  if (fs::exists(partial)) {
    auto state = backprop_from_json(read_file(partial), job.command);
    if (state && state->net.hidden == job.settings.hidden) return *state;
  }
  return backprop_start(job.settings);
}

LegacyNetFile train_one(const LegacyJob& job, const std::string& path, Progress* progress) {
  const std::string partial = path + ".partial";
  BackpropState state = start_of(job, partial);
  progress->add(std::size_t(state.epoch));
  auto saved = std::chrono::steady_clock::now();
  backprop(*job.data, job.settings, &state, [&](const BackpropState& now) {
    progress->add();
    if (std::chrono::steady_clock::now() - saved > kBetweenCheckpoints) {
      write_file_atomically(partial, to_json(now, job.command));
      saved = std::chrono::steady_clock::now();
    }
    return true;
  });
  LegacyNetFile file;
  file.command = job.command;
  file.subject = job.subject;
  file.seed = job.settings.seed;
  file.epochs = state.epoch;
  file.best_epoch = state.best_epoch;
  file.net = state.best;
  file.training_error = legacy_error(file.net, job.data->training);
  file.validation_error = legacy_error(file.net, job.data->validation);
  file.test_error = legacy_error(file.net, job.data->test);
  file.fixed = round_legacy(file.net);
  const LegacyFixed fixed(file.fixed);
  std::vector<LegacyInput> inputs;
  for (const LegacySample& sample : job.data->training) inputs.push_back(sample.input);
  file.rounding = legacy_rounding(file.net, fixed, inputs);
  if (job.measure) file.errors = job.measure(fixed);
  write_file_atomically(path, to_json(file));
  fs::remove(partial);
  return file;
}

}  // namespace

std::vector<LegacyNetFile> train_legacy(const std::vector<LegacyJob>& jobs,
                                        const std::string& folder, int threads, bool quiet) {
  const OutputFolder kept(folder);
  std::vector<LegacyNetFile> files(jobs.size());
  std::vector<std::size_t> open;
  std::size_t epochs = 0;
  const auto path = [&](std::size_t k) { return folder + "/" + jobs[k].file + ".json"; };
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (auto file = finished(path(k), jobs[k].command)) {
      files[k] = std::move(*file);
    } else {
      open.push_back(k);
      epochs += std::size_t(jobs[k].settings.epochs);
    }
  }
  // Longest first, so that no core ends up alone with a large one.
  std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
    const auto work = [&](std::size_t k) {
      return double(jobs[k].settings.hidden) * jobs[k].settings.epochs *
             double(jobs[k].data->training.size());
    };
    return work(a) > work(b);
  });
  Progress progress("training", epochs, quiet || open.empty());
  parallel_for(open.size(), threads, [&](std::size_t k) {
    files[open[k]] = train_one(jobs[open[k]], path(open[k]), &progress);
  });
  return files;
}

}  // namespace host
