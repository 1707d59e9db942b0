// urad -- the host program. Exit status: 0 done, 1 failed, 2 wrong usage.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "base/error.hpp"
#include "base/nearest_name.hpp"
#include "base/remark.hpp"
#include "command.hpp"
#include "number_range.hpp"

namespace {

constexpr int kFailed = 1, kWrongUsage = 2;

/// `urad help [COMMAND]` is `urad [COMMAND] --help`.
void add_help(CLI::App& app, std::string* topic) {
  CLI::App* help = app.add_subcommand("help", "Explain urad or one of its commands");
  help->add_option("command", *topic, "The command to explain");
  help->callback([&app, topic] {
    // app.help() would be that of the command in work, which is `help`.
    const std::string all =
        app.get_formatter()->make_help(&app, "urad", CLI::AppFormatMode::Normal);
    fmt::print("{}", topic->empty() ? all : app.get_subcommand(*topic)->help());
  });
}

std::string no_such(const std::string& word, const std::string& what,
                    const std::vector<std::string>& known) {
  const auto meant = host::nearest_name(word, known);
  return fmt::format("{}: {}{}", word, what,
                     meant ? fmt::format(", {} would do", known[*meant]) : "");
}

/// A word that nothing knows is the mistake, whatever is missing beside it.
std::string wrong_usage(const CLI::App& app, const CLI::ParseError& wrong) {
  const std::vector<std::string> unknown = app.remaining(true);
  const auto commands = app.get_subcommands();
  std::vector<std::string> known;
  if (commands.empty()) {
    for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
    return unknown.empty() ? wrong.what() : no_such(unknown.front(), "no such command", known);
  }
  const auto option = std::find_if(unknown.begin(), unknown.end(),
                                   [](const std::string& word) { return word.front() == '-'; });
  if (option == unknown.end()) return wrong.what();
  for (const CLI::App* level : std::vector<const CLI::App*>{commands.front(), &app})
    for (const CLI::Option* each : level->get_options())
      for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
  return no_such(*option, commands.front()->get_name() + " has no such option", known);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "urad: radiosity form factors and light for machines without FPU, heap or much memory");
  app.name("urad");
  app.set_version_flag("--version", URAD_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  tool::Common common;
  app.add_flag("-q,--quiet", common.quiet, "No remarks, no progress");
  app.add_option("--threads", common.threads, "Threads of long work; 0: all cores")
      ->check(tool::between(0, 1024));
  std::string topic;
  add_help(app, &topic);
  tool::add_formfactor(app, common);
  tool::add_solve(app, common);
  tool::add_bake(app, common);
  tool::add_plan(app, common);
  tool::add_train(app, common);
  tool::add_export(app, common);
  tool::add_evaluate(app, common);
  tool::add_accuracy(app, common);
  tool::add_skipping(app, common);
  tool::add_kernels(app, common);
  tool::add_networks(app, common);
  tool::add_reproduce(app, common);
  tool::add_stress(app, common);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& wrong) {
    host::remark(fmt::format("urad: {}\nTry: urad help\n", wrong_usage(app, wrong)));
    return kWrongUsage;
  } catch (const CLI::OptionNotFound&) {
    host::remark(fmt::format("urad: help: there is no command \"{}\"\nTry: urad help\n", topic));
    return kWrongUsage;
  } catch (const host::UsageError& wrong) {
    host::remark(fmt::format("urad: {}\nTry: urad help\n", wrong.what()));
    return kWrongUsage;
  } catch (const host::Error& error) {
    host::remark(fmt::format("urad: {}\n", error.what()));
    return kFailed;
  } catch (const std::bad_alloc&) {
    host::remark(
        "urad: out of memory: a smaller scene (--subdivide, --patch-size) or fewer threads would "
        "do\n");
    return kFailed;
  } catch (const std::exception& error) {
    host::remark(fmt::format("urad: {}\n", error.what()));
    return kFailed;
  }
  return 0;
}
