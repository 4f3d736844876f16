// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <exception>
#include <functional>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "commands.hpp"
#include "interrupt.hpp"
#include "perimode/core/error.hpp"
#include "perimode/core/version.hpp"
#include "perimode/linalg/threads.hpp"
#include "process.hpp"

namespace {

/// Keeps freed memory for the next work array instead of handing it back: solvers allocate and free the
/// same hundreds of megabytes many times over, and fresh pages cost as much as the arithmetic on them.
void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 64 << 20);
}

using perimode::cli::Arguments;
using perimode::cli::Console;

constexpr const char* examples = R"(Examples:
  perimode new modal plate.yaml                 write a commented case to start from
  perimode check plate.yaml                     read it, predict size, memory and solver
  perimode modal plate.yaml --threads 2         modes: table, modes.csv, modes.exo, summary.json
  perimode static plate.yaml                    displacements under loads: fields.exo, reactions.csv
  perimode transient plate.yaml                 motion in time: history.csv, fields.exo
  perimode quasistatic plate.yaml               crack growth: load_curve.csv, crack_path.csv, fields.exo
  perimode dispersion plate.yaml                how fast and how wrongly waves travel; a better micromodulus
  perimode transient plate.yaml --resume        go on with a run that was interrupted or killed
  perimode modal plate.yaml --set body.horizon.ratio=4 --output out/m4

Exit codes: 0 done, 1 ran but did not reach its goal, 2 bad input, 3 environment, 130 interrupted.)";

std::string version_text() {
  std::string text = "perimode " + perimode::version() + "\n";
  for (const auto& c : perimode::components()) text += fmt::format("  {:14} {}\n", c.name, c.version);
  text.pop_back();
  return text;
}

/// A count of threads this machine can make sense of, as a CLI11 check: the complaint, or nothing.
std::string number_of_threads(const std::string& text) {
  const int most = 4 * static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int count = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (status == std::errc() && end == text.data() + text.size() && count >= 1 && count <= most) return {};
  return fmt::format("expected 1 to {} threads, got {}", most, text);
}

/// One line about a command line that could not be read, what came and where help is.
std::string usage_error(const CLI::App& app, int argc, char** argv, std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  const auto subcommands = app.get_subcommands([](const CLI::App*) { return true; });
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word.starts_with("-")) {
      const bool known = app.get_option_no_throw(word.substr(0, word.find('='))) != nullptr;
      if (!known) what = fmt::format("expected an option of perimode, got '{}'", word);
      if (word == "--threads") ++k;  // its number is no command
      continue;
    }
    const bool known = std::any_of(subcommands.begin(), subcommands.end(),
                                   [&](const auto* s) { return s->get_name() == word; });
    if (!known) {
      std::vector<std::string> names(subcommands.size());
      std::transform(subcommands.begin(), subcommands.end(), names.begin(),
                     [](const auto* s) { return s->get_name(); });
      what = fmt::format("expected one of the commands {}, got '{}'", fmt::join(names, ", "), word);
    }
    break;
  }
  return what + "; see perimode --help";
}

/// The command as it could be typed again.
std::string command_line(int argc, char** argv) {
  std::string text = "perimode";
  for (int k = 1; k < argc; ++k) {
    std::string word = argv[k];
    const auto plain = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
             std::string_view("-_./=:,+@%").find(c) != std::string_view::npos;
    };
    if (word.empty() || !std::all_of(word.begin(), word.end(), plain)) {
      for (std::size_t at = 0; (at = word.find('\'', at)) != std::string::npos; at += 4)
        word.replace(at, 1, "'\\''");
      word.insert(0, 1, '\'');
      word += '\'';
    }
    text += ' ';
    text += word;
  }
  return text;
}

int exit_code(perimode::ErrorKind kind) {
  switch (kind) {
    case perimode::ErrorKind::invalid_input:
      return 2;
    case perimode::ErrorKind::environment:
      return 3;
    case perimode::ErrorKind::solver_failure:
      break;
  }
  return 1;
}

int guarded(const std::function<int(Console&)>& command, bool quiet) {
  Console console(quiet);
  try {
    return command(console);
  } catch (const perimode::Error& error) {
    console.error(error.what());
    return exit_code(error.kind());
  } catch (const std::bad_alloc&) {
    console.error(
        "expected memory for this case, got none left; use a larger spacing, a smaller horizon, or a larger "
        "machine");
    return 3;
  } catch (const std::exception& error) {
    console.error(fmt::format("unexpected failure: {}", error.what()));
    return 3;
  }
}

}  // namespace

int main(int argc, char** argv) {
  perimode::cli::prepare_process(argv);
  keep_freed_memory();
  perimode::cli::watch_for_interrupts();
  CLI::App app{
      "Perimode: vibration modes, statics, motion in time, crack growth and wave dispersion of bond-based "
      "peridynamic bodies",
      "perimode"};
  app.footer(examples);
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();

  Arguments arguments;
  arguments.command_line = command_line(argc, argv);
  int threads = 0;
  bool quiet = false;
  std::function<int(Console&)> command;
  app.add_option("--threads", threads, "threads to use (default: all cores)")->check(number_of_threads);
  app.add_flag("--quiet", quiet, "print results and errors only");

  const auto common = [&](CLI::App* sub) {
    sub->add_option("case", arguments.case_file, "case file (YAML or JSON)")->required();
    sub->add_option("--set", arguments.set, "override a value of the case: key=value, key a dotted path")
        ->take_all()
        ->allow_extra_args(false);
  };
  const auto result = [&](CLI::App* sub) {
    sub->add_option("--output", arguments.output, "result folder, instead of the case's output.directory");
    sub->add_flag("--force", arguments.force, "replace an earlier result");
  };
  CLI::App* modal = app.add_subcommand("modal", "compute vibration modes");
  common(modal);
  result(modal);
  CLI::Option* matrices =
      modal->add_flag("--matrices", arguments.matrices, "also write K.mtx and M.mtx (Matrix Market)");
  modal
      ->add_option("--crack-growth", arguments.crack_growth,
                   "frequencies while the pre-cracks grow in so many steps: crack_growth.csv")
      ->excludes(matrices);
  modal->footer(
      "Example: perimode modal plate.yaml --set analysis.modal.modes=40 --output out/plate --force");
  modal->callback([&] { command = [&](Console& c) { return run_modal(arguments, c); }; });

  CLI::App* statics = app.add_subcommand("static", "compute displacements under loads");
  common(statics);
  result(statics);
  statics->footer(
      "Example: perimode static plate.yaml --set analysis.static.tolerance=1e-10 --output out/plate --force");
  statics->callback([&] { command = [&](Console& c) { return run_static(arguments, c); }; });

  CLI::App* transient = app.add_subcommand("transient", "follow a body through time");
  common(transient);
  result(transient);
  transient->add_flag("--resume", arguments.resume, "go on from the last checkpoint of an unfinished run");
  transient->footer(
      "Example: perimode transient plate.yaml --set analysis.transient.end=2.0e-3 --output out/plate "
      "--force");
  transient->callback([&] { command = [&](Console& c) { return run_transient(arguments, c); }; });

  CLI::App* quasistatic =
      app.add_subcommand("quasistatic", "grow cracks under loads that never outrun equilibrium");
  common(quasistatic);
  result(quasistatic);
  quasistatic->add_flag("--resume", arguments.resume, "go on from the last checkpoint of an unfinished run");
  quasistatic->footer(
      "Example: perimode quasistatic plate.yaml --set analysis.quasistatic.fields_every=50 --output "
      "out/plate "
      "--force");
  quasistatic->callback([&] { command = [&](Console& c) { return run_quasistatic(arguments, c); }; });

  CLI::App* dispersion =
      app.add_subcommand("dispersion", "waves of the case's lattice and an optimised micromodulus");
  common(dispersion);
  result(dispersion);
  dispersion->footer(
      "Example: perimode dispersion plate.yaml --set analysis.dispersion.optimise.lower_bound=0 --output "
      "out/plate --force");
  dispersion->callback([&] { command = [&](Console& c) { return run_dispersion(arguments, c); }; });

  CLI::App* check = app.add_subcommand("check", "read a case and predict what it takes; runs nothing");
  common(check);
  check->callback([&] { command = [&](Console& c) { return run_check(arguments, c); }; });

  CLI::App* fresh = app.add_subcommand("new", "write a commented case file");
  fresh->require_subcommand(1);
  const auto fresh_case = [&](const char* name, const char* what, int (*run)(const Arguments&, Console&)) {
    CLI::App* sub = fresh->add_subcommand(name, what);
    sub->add_option("file", arguments.template_to, "where to write it (default: standard output)");
    sub->add_flag("--force", arguments.force, "replace an existing file");
    sub->callback([&command, &arguments, run] {
      command = [&arguments, run](Console& c) { return run(arguments, c); };
    });
  };
  fresh_case("modal", "a template for modes", perimode::cli::run_new_modal);
  fresh_case("static", "a template for statics", perimode::cli::run_new_static);
  fresh_case("transient", "a template for motion in time", perimode::cli::run_new_transient);
  fresh_case("quasistatic", "a template for crack growth", perimode::cli::run_new_quasistatic);
  fresh_case("dispersion", "a template for waves and a better micromodulus",
             perimode::cli::run_new_dispersion);

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForVersion& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    fmt::print(stderr, "perimode: error: {}\n", usage_error(app, argc, argv, e.what()));
    return 2;
  }
  return guarded(
      [&](Console& console) {
        if (threads > 0) perimode::set_threads(threads);
        return command(console);
      },
      quiet);
}
