// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "io/case_sections.hpp"

namespace perimode::case_file {

namespace {

/// Keys that belong to one control only.
void refuse_keys_of_the_other(const Section& section, QuasistaticControl control) {
  const auto refuse = [&](std::initializer_list<const char*> keys, const char* has_none, const char* remedy) {
    for (const char* key : keys) section.refuse(key, fmt::format("no `{}` with {}", key, has_none), remedy);
  };
  if (control == QuasistaticControl::event) {
    refuse({"steps", "end", "break_at_once"}, "event control",
           "it belongs to steps: remove it, or give control: steps");
  } else {
    refuse({"dead_loads"}, "control: steps",
           "there a load is constant where it has no `time`: put it into loads");
    refuse(
        {"griffith"}, "control: steps",
        "it is the load factor of event control at which the crack grows: remove it, or give control: event");
  }
}

/// Loads of event control have no functions of time.
void refuse_times(const Cursor& cursor, const std::vector<Load>& loads, const char* remedy) {
  const std::vector<Cursor> items = cursor.items("[]");
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (loads[k].time.kind == TimeFunction::Kind::constant) continue;
    Cursor(*items[k].node().find("time"), items[k].path() + ".time")
        .complain("no function of time in event control", remedy);
  }
}

QuasistaticStop read_stop(const Cursor& cursor) {
  const Section section(cursor, {"separated", "events", "load_drop"});
  QuasistaticStop stop;
  if (const auto separated = section.find("separated")) stop.separated = separated->boolean();
  if (const auto events = section.find("events")) stop.events = events->integer(1, "1000");
  if (const auto drop = section.find("load_drop")) {
    stop.load_drop = drop->number({"", "0.9"});
    if (stop.load_drop >= 1.0) {
      drop->complain("a number > 0 and < 1", "for example 0.9: once the load has fallen by 90 % of its peak");
    }
  }
  return stop;
}

void read_solver(const Section& section, QuasistaticOptions& options) {
  if (const auto solver = section.find("solver")) {
    using Only = std::optional<SolveWay>;
    options.solver.only = solver->choice<Only>({{"auto", Only()},
                                                {"update", SolveWay::update},
                                                {"stale", SolveWay::stale},
                                                {"refactor", SolveWay::refactor},
                                                {"iterate", SolveWay::iterate}});
    options.matrix_free = options.solver.only == SolveWay::iterate;
  }
  if (const auto tolerance = section.find("tolerance")) {
    options.solver.tolerance = tolerance->number({"", "1e-10"});
    if (options.solver.tolerance < 1e-15 || options.solver.tolerance >= 1.0) {
      tolerance->complain("a number >= 1e-15 and < 1", "for example 1e-10");
    }
  }
}

void read_steps(const Section& section, QuasistaticOptions& options) {
  if (const auto steps = section.find("steps")) options.steps = steps->integer(1, "100");
  if (const auto end = section.find("end")) options.end = end->number({"s", "1"});
  if (const auto most = section.find("break_at_once")) {
    const bool all = most->node().kind == CaseNode::Kind::scalar && most->node().text == "all";
    options.break_at_once = all ? 0 : most->integer(1, "1, or all");
  }
}

}  // namespace

void read_quasistatic(const Cursor& cursor, InputFiles& files, Case& result) {
  QuasistaticOptions options;
  options.where = cursor.where();
  result.quasistatic_where = cursor.where();
  if (cursor.node().kind == CaseNode::Kind::null) {  // `quasistatic:` with nothing: all defaults
    result.quasistatic = options;
    return;
  }
  const BodyFacts facts = facts_of(result.model);
  const Section section(
      cursor, {"control", "loads", "dead_loads", "no_fail", "stop", "loose", "steps", "end", "break_at_once",
               "solver", "tolerance", "griffith", "fields_every", "checkpoint_every"});
  if (const auto control = section.find("control")) {
    options.control = control->choice<QuasistaticControl>(
        {{"event", QuasistaticControl::event}, {"steps", QuasistaticControl::steps}});
  }
  refuse_keys_of_the_other(section, options.control);
  if (const auto loads = section.find("loads")) {
    options.loads = read_loads(*loads, facts, files);
    if (options.control == QuasistaticControl::event) {
      refuse_times(*loads, options.loads,
                   "the load factor takes its place: remove it, or give control: steps");
    }
  }
  if (const auto loads = section.find("dead_loads")) {
    options.dead_loads = read_loads(*loads, facts, files);
    refuse_times(*loads, options.dead_loads, "dead loads act in full at every load factor: remove it");
  }
  if (const auto regions = section.find("no_fail")) {
    for (const Cursor& item : regions->items("[ { face: y+, layers: 3 } ]"))
      options.no_fail.push_back(read_region(item, facts));
  }
  if (const auto stop = section.find("stop")) options.stop = read_stop(*stop);
  if (const auto loose = section.find("loose")) {
    options.loose =
        loose->choice<LoosePieces>({{"hold", LoosePieces::hold}, {"remove", LoosePieces::remove}});
  }
  read_steps(section, options);
  read_solver(section, options);
  if (const auto griffith = section.find("griffith")) {
    options.griffith = griffith->boolean();
    if (options.griffith && result.model.precracks.empty()) {
      griffith->complain(
          "false without a pre-crack",
          "it is the load at which the first of body.precracks grows: add one, or remove the key");
    }
  }
  if (options.griffith && !options.dead_loads.empty()) {
    section.find("griffith")
        ->complain("false beside dead_loads", "the load of Griffith's criterion is that of loads alone");
  }
  if (const auto every = section.find("fields_every")) options.fields_every = every->integer(1, "100");
  if (const auto every = section.find("checkpoint_every"))
    options.checkpoint_every = every->integer(1, "1000");
  result.quasistatic = std::move(options);
}

}  // namespace perimode::case_file
