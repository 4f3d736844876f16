// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/case_sections.hpp"

namespace perimode::case_file {

namespace {

constexpr double lowest_alpha = -1.0 / 3.0;
constexpr double default_alpha = -0.1;  ///< of hht: damps what a step resolves badly

/// Keys that belong to some methods only.
void refuse_keys_of_others(const Section& section, const std::string& method) {
  const auto only = [&](std::initializer_list<const char*> keys, bool fits, const char* owner) {
    for (const char* key : keys) {
      if (fits) continue;
      section.refuse(key, fmt::format("no `{}` with the method {}", key, method),
                     fmt::format("it belongs to {}: remove it, or change the method", owner));
    }
  };
  only({"beta", "gamma"}, method == "newmark", "newmark");
  only({"alpha"}, method == "hht", "hht");
  only({"modes"}, method == "modal", "modal");
  only({"solver", "tolerance"}, method == "newmark" || method == "hht", "newmark and hht");
  only({"operator", "sponge", "no_fail"}, method != "modal", "the other methods");
}

void read_method(const Section& section, TransientOptions& options) {
  std::string name = "central_difference";
  if (const auto method = section.find("method")) {
    name = method->choice<std::string>({{"central_difference", "central_difference"},
                                        {"newmark", "newmark"},
                                        {"hht", "hht"},
                                        {"modal", "modal"}});
    options.method = method->choice<TimeMethod>({{"central_difference", TimeMethod::central_difference},
                                                 {"newmark", TimeMethod::newmark},
                                                 {"hht", TimeMethod::hht},
                                                 {"modal", TimeMethod::modal}});
  }
  refuse_keys_of_others(section, name);
  if (const auto beta = section.find("beta")) options.newmark.beta = beta->number({"", "0.25"});
  if (const auto gamma = section.find("gamma")) {
    options.newmark.gamma = gamma->number({"", "0.5"});
    if (options.newmark.gamma < 0.5) gamma->complain("a number >= 0.5", "less makes every motion grow");
  }
  if (options.method == TimeMethod::hht) options.newmark.alpha = default_alpha;
  if (const auto alpha = section.find("alpha")) {
    options.newmark.alpha = alpha->number({"", "-0.1", Sign::any});
    if (options.newmark.alpha < lowest_alpha || options.newmark.alpha > 0.0) {
      alpha->complain("a number from -1/3 to 0", "for example -0.1; 0 is Newmark's method without damping");
    }
  }
  if (const auto modes = section.find("modes")) options.modes = modes->integer(1, "20");
  if (const auto solver = section.find("solver")) {
    options.solver = solver->choice<ImplicitSolver>({{"auto", ImplicitSolver::automatic},
                                                     {"factor", ImplicitSolver::factor},
                                                     {"cg", ImplicitSolver::cg}});
  }
  if (const auto tolerance = section.find("tolerance")) {
    options.tolerance = tolerance->number({"", "1e-12"});
    if (options.tolerance < 1e-15 || options.tolerance >= 1.0) {
      tolerance->complain("a number >= 1e-15 and < 1", "for example 1e-12");
    }
  }
}

void read_operator(const Section& section, const BodyFacts& facts, TransientOptions& options) {
  const auto form = section.find("operator");
  if (!form) return;
  options.form = form->choice<StiffnessForm>({{"auto", StiffnessForm::automatic},
                                              {"stencil", StiffnessForm::stencil},
                                              {"bonds", StiffnessForm::bonds},
                                              {"assembled", StiffnessForm::blocks}});
  if (options.form == StiffnessForm::stencil && !facts.grid) {
    form->complain("auto, bonds or assembled for a cloud", "a stencil needs a grid");
  }
}

/// Neither a whole number of steps nor the stable step is asked for here: the run knows both.
void read_times(const Section& section, TransientOptions& options) {
  const Cursor end = section.need("end", "1.0e-3");
  options.end = end.number({"s", "1.0e-3"});
  if (const auto dt = section.find("dt"); dt && dt->node().text != "auto") {
    options.dt = dt->number({"s (or auto)", "1.0e-7"});
    options.dt_where = dt->where();
    if (options.dt > options.end * (1.0 + 1e-9)) {
      dt->complain(fmt::format("a step of at most {} s, the end", options.end),
                   "give a shorter step, or auto");
    }
  }
  if (const auto every = section.find("history_every")) options.history_every = every->integer(1, "10");
  if (const auto every = section.find("checkpoint_every"))
    options.checkpoint_every = every->integer(1, "10000");
  (void)section.at_most_one({"fields_at", "fields_every"});
  if (const auto every = section.find("fields_every")) options.fields_every = every->integer(1, "100");
  if (const auto at = section.find("fields_at")) {
    for (const Cursor& item : at->items("[5.0e-4, 1.0e-3]")) {
      const double time = item.number({"s", "5.0e-4", Sign::non_negative});
      if (time > options.end * (1.0 + 1e-9)) {
        item.complain(fmt::format("a time of at most {} s, the end", options.end), "remove it, or end later");
      }
      options.fields_at.push_back(time);
    }
    std::sort(options.fields_at.begin(), options.fields_at.end());
  }
}

InitialField read_field(const Cursor& cursor, int dimension, InputFiles& files) {
  if (cursor.node().kind != CaseNode::Kind::map) return FormulaField{read_formulas(cursor, dimension)};
  const Section section(cursor, {"file", "mode"});
  if (section.exactly_one({"file", "mode"}) == "file") {
    return TableField{files.add(*section.find("file"), "initial.csv")};
  }
  const Section mode(*section.find("mode"), {"file", "number", "scale"});
  ModeField field{files.add(mode.need("file", "out/modes.exo"), "out/modes.exo", true)};
  field.mode = mode.need("number", "1").integer(1, "1");
  if (const auto scale = mode.find("scale")) field.scale = scale->number({"", "1.0e-3", Sign::any});
  return field;
}

InitialSpec read_initial(const Cursor& cursor, int dimension, InputFiles& files) {
  const Section section(cursor, {"displacement", "velocity"});
  InitialSpec initial;
  initial.where = cursor.where();
  if (const auto u = section.find("displacement")) initial.displacement = read_field(*u, dimension, files);
  if (const auto v = section.find("velocity")) initial.velocity = read_field(*v, dimension, files);
  return initial;
}

void read_damping(const Cursor& cursor, const BodyFacts& facts, TransientOptions& options) {
  const Section section(cursor, {"rayleigh", "nodal"});
  if (const auto rayleigh = section.find("rayleigh")) {
    const std::vector<Cursor> numbers = rayleigh->items("[100, 1.0e-8]");
    if (numbers.size() != 2) {
      rayleigh->complain("a list of 2 numbers, alpha in 1/s and beta in s",
                         "for example [100, 1.0e-8], C = alpha M + beta K");
    }
    options.rayleigh_mass = numbers[0].number({"1/s", "100", Sign::non_negative});
    options.rayleigh_stiffness = numbers[1].number({"s", "1.0e-8", Sign::non_negative});
  }
  const auto nodal = section.find("nodal");
  if (!nodal) return;
  if (options.method == TimeMethod::modal) {
    section.refuse("nodal", "no `nodal` damping with the method modal",
                   "use rayleigh, whose damping keeps modes apart, or change the method");
  }
  for (const Cursor& item : nodal->items("[ { rate: 1.0e+4, at: { block: pad } } ]")) {
    const Section one(item, {"rate", "at"});
    options.damping.push_back({one.need("rate", "1.0e+4").number({"1/s", "1.0e+4"}),
                               read_region(one.need("at", "{ block: pad }"), facts), item.where()});
  }
}

Sponge read_sponge(const Cursor& cursor, const Model& model) {
  const Section section(cursor, {"faces", "width", "rate", "power"});
  Sponge sponge;
  sponge.where = cursor.where();
  const Cursor faces = section.need("faces", "[x-, x+]");
  std::set<std::pair<int, bool>> known;
  for (const Cursor& item : faces.items("[x-, x+]")) {
    const Face face = read_face(item, model.dimension);
    if (model.periodic[face.axis]) {
      item.complain(fmt::format("no sponge along {}, which is periodic", "xyz"[face.axis]),
                    "remove the face, or the axis from body.periodic");
    }
    if (!known.emplace(face.axis, face.upper).second) item.complain("every face once", "remove it");
    sponge.faces.push_back(face);
  }
  if (sponge.faces.empty()) faces.complain("at least one face", "for example [x-, x+]");
  sponge.width = section.need("width", "0.1").number({"m", "0.1"});
  if (const auto rate = section.find("rate")) sponge.rate = rate->number({"1/s", "1.0e+5"});
  if (const auto power = section.find("power")) sponge.power = power->number({"", "3"});
  return sponge;
}

/// A point of the body's box, where a grid tells it; clouds are looked at when they have been read.
Coordinates read_probe_point(const Cursor& cursor, const Model& model) {
  Coordinates point = cursor.point(model.dimension);
  const auto* grid = std::get_if<GridSpec>(&model.particles);
  for (int a = 0; grid != nullptr && a < model.dimension; ++a) {
    const double slack = 1e-9 * grid->spacing;
    if (point[a] >= grid->lower[a] - slack && point[a] <= grid->upper[a] + slack) continue;
    cursor.complain(
        fmt::format("a point of the body, {} <= {} <= {} m", grid->lower[a], "xyz"[a], grid -> upper[a]),
        fmt::format("{} is {}: move the probe into the body", "xyz"[a], point[a]));
  }
  return point;
}

/// Names go into the header of history.csv.
void check_probe_name(const CaseNode& node) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (!node.key.empty() && std::all_of(node.key.begin(), node.key.end(), plain)) return;
  invalid_input({"a name of letters, digits, _ and - for a probe", fmt::format("'{}'", node.key),
                 "it becomes the name of columns in history.csv", node.key_where});
}

std::vector<TransientProbe> read_probes(const Cursor& cursor, const Model& model) {
  using Kind = TransientProbe::Kind;
  std::vector<TransientProbe> probes;
  std::set<std::string> columns = {"step",    "time",   "kinetic", "strain",       "external_work",
                                   "damping", "broken", "balance", "boundary_work"};
  for (const Cursor& entry : cursor.entries("{ tip: { displacement_at: [1.0, 0.25] } }")) {
    check_probe_name(entry.node());
    const Section section(entry, {"displacement_at", "velocity_at", "strain_between"});
    const std::string_view kind = section.exactly_one({"displacement_at", "velocity_at", "strain_between"});
    const Cursor value = *section.find(kind);
    TransientProbe probe;
    probe.name = entry.node().key;
    probe.where = value.where();
    probe.kind = kind == "displacement_at" ? Kind::displacement
                 : kind == "velocity_at"   ? Kind::velocity
                                           : Kind::strain;
    if (probe.kind == Kind::strain) {
      const std::vector<Cursor> ends = value.items("[[0.4, 0.2], [0.6, 0.2]]");
      if (ends.size() != 2) value.complain("a list of 2 points", "for example [[0.4, 0.2], [0.6, 0.2]]");
      probe.at = read_probe_point(ends[0], model);
      probe.to = read_probe_point(ends[1], model);
      if (probe.at == probe.to) ends[1].complain("another point than the first", "a strain needs a length");
    } else {
      probe.at = read_probe_point(value, model);
    }
    for (const std::string& column : probe_columns({probe}, model.dimension)) {
      if (columns.insert(column).second) continue;
      invalid_input({"columns of history.csv with names of their own", fmt::format("'{}' again", column),
                     "give the probe another name", entry.node().key_where});
    }
    probes.push_back(std::move(probe));
  }
  return probes;
}

}  // namespace

void read_transient(const Cursor& cursor, InputFiles& files, Case& result) {
  const BodyFacts facts = facts_of(result.model);
  const Section section(
      cursor,
      {"method", "dt",        "end",           "beta",      "gamma",        "alpha",           "modes",
       "solver", "tolerance", "operator",      "initial",   "loads",        "damping",         "sponge",
       "probes", "no_fail",   "history_every", "fields_at", "fields_every", "checkpoint_every"});
  TransientOptions options;
  options.where = cursor.where();
  options.kinematics = result.kinematics;
  read_method(section, options);
  if (options.kinematics == Kinematics::large_rotation && options.method != TimeMethod::central_difference) {
    section.need("method", "")
        .complain("central_difference with kinematics: large_rotation",
                  "the other methods are those of the linearised body");
  }
  read_operator(section, facts, options);
  read_times(section, options);
  if (const auto initial = section.find("initial"))
    result.initial = read_initial(*initial, facts.dimension, files);
  if (const auto loads = section.find("loads")) options.loads = read_loads(*loads, facts, files);
  if (const auto damping = section.find("damping")) read_damping(*damping, facts, options);
  if (const auto sponge = section.find("sponge")) options.sponge = read_sponge(*sponge, result.model);
  if (const auto regions = section.find("no_fail")) {
    for (const Cursor& item : regions->items("[ { face: x-, layers: 2 } ]"))
      options.no_fail.push_back(read_region(item, facts));
  }
  if (const auto probes = section.find("probes")) options.probes = read_probes(*probes, result.model);
  result.transient = std::move(options);
  result.transient_where = cursor.where();
}

}  // namespace perimode::case_file
