// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/case_sections.hpp"
#include "perimode/material/micromodulus.hpp"

namespace perimode::case_file {

namespace {

constexpr const char* example_path[] = {"[[0], [1]]", "[[0, 0], [1, 0], [1, 1], [0, 0]]",
                                        "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [0, 0, 0]]"};

std::vector<Coordinates> read_path(const Cursor& cursor, int dimension) {
  const char* example = example_path[dimension - 1];
  const std::vector<Cursor> items = cursor.items(example);
  if (items.size() < 2) {
    cursor.complain("at least 2 points, in pi/spacing",
                    fmt::format("a path leads from one to the next: {}", example));
  }
  std::vector<Coordinates> path(items.size());
  for (std::size_t k = 0; k < items.size(); ++k) {
    path[k] = items[k].point(dimension, "pi/spacing");
    constexpr double farthest = 100.0;
    const auto far =
        std::find_if(path[k].begin(), path[k].end(), [](double x) { return std::abs(x) > farthest; });
    if (far != path[k].end()) {
      invalid_input(
          {fmt::format("{}: components from {} to {}, in pi/spacing", items[k].path(), -farthest, farthest),
           fmt::format("{}", *far), "waves repeat every 2", items[k].where()});
    }
    if (k > 0 && path[k] == path[k - 1]) {
      items[k].complain("a point other than the one before", "leave one of them out");
    }
  }
  return path;
}

int read_zone(const Cursor& cursor, int dimension) {
  constexpr double most = 1e9;
  const int points = cursor.integer(2, "101");
  if (std::pow(points, dimension) > most) {
    cursor.complain(
        fmt::format("at most {:.0f} points per axis", std::floor(std::pow(most, 1.0 / dimension) + 1e-6)),
        "for example 101");
  }
  return points;
}

/// A number of lines of a table.
int read_lines(const Cursor& cursor, int least, const char* example) {
  constexpr int most = 1'000'000;
  const int lines = cursor.integer(least, example);
  if (lines > most) cursor.complain(fmt::format("at most {}", most), fmt::format("for example {}", example));
  return lines;
}

PolarSpec read_polar(const Cursor& cursor, int dimension) {
  if (dimension == 1) cursor.complain("no polar diagram in 1D", "there is one direction: leave the key out");
  const Section section(cursor, {"wave_number", "directions"});
  PolarSpec polar;
  polar.wave_number = section.need("wave_number", "0.5").number({"pi/spacing", "0.5", Sign::non_negative});
  if (const auto directions = section.find("directions"))
    polar.directions = read_lines(*directions, 1, "360");
  return polar;
}

void read_time_step(const Section& section, DispersionSpec& spec) {
  if (const auto step = section.find("time_step")) {
    spec.time_step = step->number({"s", "1.0e-7"});
  } else {
    section.refuse("integrator", "`integrator` beside `time_step` only", "give the time step, or remove it");
  }
  if (const auto integrator = section.find("integrator")) {
    spec.integrator = integrator->choice<StepIntegrator>(
        {{"central_difference", StepIntegrator::central_difference}, {"newmark", StepIntegrator::newmark}});
  }
}

std::array<double, 2> read_weights(const Cursor& cursor, int dimension) {
  const std::vector<Cursor> items = cursor.items("[1, 1]");
  if (items.size() != 2) cursor.complain("a list of 2 numbers, for P and S", "for example [1, 1]");
  const std::array<double, 2> weights = {items[0].number({"", "1", Sign::non_negative}),
                                         items[1].number({"", "1", Sign::non_negative})};
  if (weights[0] + (dimension > 1 ? weights[1] : 0.0) == 0.0) {
    invalid_input({cursor.path() +
                       (dimension > 1 ? ": a weight > 0" : ": a weight > 0 of P, the one kind of wave in 1D"),
                   fmt::format("[{}, {}]", weights[0], weights[1]), "for example [1, 1]", cursor.where()});
  }
  return weights;
}

constexpr const char* no_error_is_made_least =
    "it solves as many equations as there are numbers, and no error is made least: leave the key out, or "
    "write method: least_squares";

void read_method(const Section& section, int dimension, OptimiseOptions& options) {
  if (const auto method = section.find("method")) {
    options.method =
        method->choice<OptimiseMethod>({{"least_squares", OptimiseMethod::least_squares},
                                        {"point_collocation", OptimiseMethod::point_collocation},
                                        {"subdomain_collocation", OptimiseMethod::subdomain_collocation},
                                        {"galerkin", OptimiseMethod::galerkin}});
    if (dimension > 1 && options.method != OptimiseMethod::least_squares) {
      method->complain(fmt::format("least_squares in {}D", dimension),
                       "the equations of the others have one solution in 1D only");
    }
  }
  if (const auto norm = section.find("norm")) {
    options.norm = norm->choice<ErrorNorm>({{"l2", ErrorNorm::l2}, {"l1", ErrorNorm::l1}});
  }
  if (const auto domain = section.find("domain")) {
    options.domain =
        domain->choice<ErrorDomain>({{"contour", ErrorDomain::contour}, {"zone", ErrorDomain::zone}});
    if (options.norm == ErrorNorm::l1 && options.domain == ErrorDomain::zone) {
      domain->complain("contour with the norm l1",
                       "off the contour waves are not linear in what is sought: give norm: l2");
    }
  }
  if (options.method != OptimiseMethod::least_squares && options.norm == ErrorNorm::l1) {
    section.find("norm")->complain("l2 with a method of equations", no_error_is_made_least);
  }
}

void read_targets(const Section& section, int dimension, OptimiseOptions& options) {
  if (const auto bound = section.find("lower_bound")) {
    const bool none = bound->node().kind == CaseNode::Kind::scalar && bound->node().text == "none";
    if (!none && !bound->is_number()) bound->complain("a number, or none", "for example 0.5");
    if (!none) options.lower_bound = bound->number({"", "0.5", Sign::any});
    if (!none && options.method != OptimiseMethod::least_squares)
      bound->complain("none with a method of equations", no_error_is_made_least);
  }
  if (const auto ratio = section.find("poissons_ratio")) {
    const bool theory = ratio->node().kind == CaseNode::Kind::scalar && ratio->node().text == "theory";
    if (!theory && dimension == 1) {
      section.refuse("poissons_ratio", "no Poisson's ratio in 1D", "leave it out");
    }
    if (!theory && !ratio->is_number()) ratio->complain("a number, or theory", "for example 0.25");
    if (!theory) {
      options.poissons_ratio = ratio->number({"", "0.25", Sign::any});
      if (!(*options.poissons_ratio > -1.0 && *options.poissons_ratio < 0.5)) {
        ratio->complain("a number > -1 and < 0.5, or theory", "for example 0.25");
      }
    }
  }
  if (const auto weights = section.find("weights")) options.weights = read_weights(*weights, dimension);
}

/// The kernel to be bettered is a multiple of the constant one in whole cells.
void check_kernel(const Cursor& cursor, const Model& model) {
  const auto refuse = [&](const char* expected, const std::string& got, const char* remedy) {
    invalid_input({cursor.path() + ": " + expected, got, remedy, cursor.where()});
  };
  const Kernel kernel = model.material.micromodulus.kernel;
  if (kernel != Kernel::constant && !is_lattice_kernel(kernel)) {
    refuse("a material of the kernel constant, fourier or shells", name(kernel),
           "what is sought multiplies the constant kernel: take that");
  }
  if (model.volume_correction != VolumeCorrection::none) {
    refuse("a material with volume_correction: none",
           model.volume_correction == VolumeCorrection::linear ? "linear" : "exact",
           "what is sought multiplies whole cells: leave the correction out");
  }
}

void read_optimise(const Cursor& cursor, const Model& model, DispersionSpec& spec) {
  OptimiseOptions options;
  spec.optimise_where = cursor.where();
  check_kernel(cursor, model);
  if (cursor.node().kind != CaseNode::Kind::null) {
    const Section section(cursor,
                          {"method", "norm", "domain", "lower_bound", "poissons_ratio", "weights", "fit"});
    read_method(section, model.dimension, options);
    read_targets(section, model.dimension, options);
    if (const auto fit = section.find("fit")) {
      spec.fit = fit->integer(0, "4");
      spec.fit_where = fit->where();
    }
  }
  spec.optimise = options;
}

SpectrumSpec read_spectrum(const Cursor& cursor, const InputFiles& files) {
  const Section section(cursor, {"run"});
  const Cursor run = section.need("run", "out/pulse");
  return {files.directory / run.text("out/pulse"), run.where()};
}

/// Keys that need the lattice of a grid, or the particles of a cloud.
void refuse_keys_of_the_other(const Section& section, bool grid) {
  if (grid) {
    section.refuse("waves", "no `waves` with a grid", "it belongs to clouds: give a `path`, or remove it");
    return;
  }
  for (const char* key :
       {"path", "points", "zone", "polar", "finite_difference", "optimise", "spectrum", "phase_error"}) {
    section.refuse(key, fmt::format("no `{}` with a cloud", key),
                   "it needs the lattice of a grid: remove it; `waves` says how many are looked at");
  }
}

}  // namespace

void read_dispersion(const Cursor& cursor, InputFiles& files, Case& result) {
  DispersionSpec spec;
  spec.where = cursor.where();
  if (cursor.node().kind == CaseNode::Kind::null) {  // `dispersion:` with nothing: all defaults
    result.dispersion = spec;
    return;
  }
  const Model& model = result.model;
  const Section section(cursor, {"path", "points", "zone", "time_step", "integrator", "phase_error", "polar",
                                 "finite_difference", "optimise", "spectrum", "waves"});
  refuse_keys_of_the_other(section, std::holds_alternative<GridSpec>(model.particles));
  if (const auto path = section.find("path")) spec.path = read_path(*path, model.dimension);
  if (const auto points = section.find("points")) {
    constexpr std::size_t corners_of_contour[] = {2, 4, 5};
    const std::size_t corners =
        spec.path.empty() ? corners_of_contour[model.dimension - 1] : spec.path.size();
    spec.points = read_lines(*points, 2, "300");
    if (static_cast<std::size_t>(spec.points) < corners) {
      points->complain(fmt::format("at least {} points, one for every corner of the path", corners),
                       "300 are usual");
    }
  }
  if (const auto zone = section.find("zone")) spec.zone = read_zone(*zone, model.dimension);
  read_time_step(section, spec);
  if (const auto error = section.find("phase_error")) {
    spec.phase_error = error->number({"", "0.05"});
    if (spec.phase_error >= 1.0) error->complain("a number > 0 and < 1", "for example 0.05");
  }
  if (const auto polar = section.find("polar")) spec.polar = read_polar(*polar, model.dimension);
  if (const auto courant = section.find("finite_difference")) {
    if (model.dimension != 1) {
      section.refuse("finite_difference", fmt::format("no finite differences in {}D", model.dimension),
                     "their curve is that of the wave equation in 1D: remove it");
    }
    spec.finite_difference = courant->number({"", "0.5", Sign::non_negative});
    if (*spec.finite_difference > 1.0) {
      courant->complain("a Courant number >= 0 and <= 1", "for example 0.5; 0 leaves time exact");
    }
  }
  if (const auto optimise = section.find("optimise")) read_optimise(*optimise, model, spec);
  if (const auto spectrum = section.find("spectrum")) {
    spec.spectrum = read_spectrum(*spectrum, files);
  }
  if (const auto waves = section.find("waves")) spec.waves = read_lines(*waves, 1, "10");
  result.dispersion = std::move(spec);
}

}  // namespace perimode::case_file
