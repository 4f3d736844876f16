// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "perimode/assembly/body.hpp"
#include "perimode/assembly/precracks.hpp"
#include "perimode/geometry/mesh.hpp"

namespace perimode {

namespace {

double section_of(const Model& model) {
  if (model.dimension == 1) return model.area;
  return model.dimension == 2 ? model.thickness : 1.0;
}

void require_positive(double value, const char* name, const Where& where) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    invalid_input({fmt::format("{} > 0", name), fmt::format("{}", value), "give it in SI units", where});
  }
}

template <int Dim>
Particles<Dim> cloud_particles(const CloudSpec& spec, double section) {
  CloudData data = read_particles(spec.file, Dim, section);
  Particles<Dim> p;
  std::map<std::string, int> number = {{"", 0}};
  for (std::size_t i = 0; i < data.volume.size(); ++i) {
    p.position.push_back(Eigen::Map<const Point<Dim>>(data.position.data() + i * Dim));
    p.volume.push_back(data.volume[i]);
    const std::string name = data.block.empty() ? std::string() : data.block[i];
    const auto [it, fresh] = number.emplace(name, static_cast<int>(p.block_names.size()));
    if (fresh) p.block_names.push_back(name);
    p.block.push_back(it->second);
  }
  return p;
}

template <int Dim>
Particles<Dim> make_particles(const Model& model) {
  Particles<Dim> particles;
  if (const auto* spec = std::get_if<GridSpec>(&model.particles)) {
    const auto grid = make_grid<Dim>(spec->lower, spec->upper, spec->spacing, spec->where);
    particles = grid_particles(grid, section_of(model));
    std::vector<Index> removed;
    for (const auto& region : spec->remove) {
      const auto here = select(region, particles);
      removed.insert(removed.end(), here.begin(), here.end());
    }
    std::sort(removed.begin(), removed.end());
    removed.erase(std::unique(removed.begin(), removed.end()), removed.end());
    particles = without(particles, removed);
    if (particles.count() == 0) {
      invalid_input({"a body with particles", "none left after `remove`", "remove less", spec->where});
    }
  } else {
    particles = cloud_particles<Dim>(std::get<CloudSpec>(model.particles), section_of(model));
  }
  for (const auto& block : model.blocks) {  // where blocks overlap the last one holds
    const auto inside = select(block.region, particles);
    if (inside.empty()) {
      invalid_input({fmt::format("block '{}' to hold at least one particle", block.name), "none",
                     "move or enlarge its region", block.region.where});
    }
    const auto known = std::find(particles.block_names.begin() + 1, particles.block_names.end(), block.name);
    const auto number = static_cast<int>(known - particles.block_names.begin());
    if (known == particles.block_names.end()) particles.block_names.push_back(block.name);
    for (Index i : inside) particles.block[i] = number;
  }
  return particles;
}

/// The period of a cloud per axis, 0 where it does not repeat itself.
template <int Dim>
Point<Dim> cloud_period(const Model& model, const Particles<Dim>& particles) {
  const auto& spec = std::get<CloudSpec>(model.particles);
  Point<Dim> period = Point<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    if (!model.periodic[a]) continue;
    const double given = static_cast<std::size_t>(a) < spec.period.size() ? spec.period[a] : 0.0;
    if (!(given > 0.0) || !std::isfinite(given)) {
      invalid_input({fmt::format("a period > 0 (m) of the cloud along {}, which is periodic", "xyz"[a]),
                     spec.period.empty() ? "none" : fmt::format("{}", given),
                     "write particles: { file: cloud.csv, period: [..] }, a number per axis", spec.where});
    }
    const auto [low, high] =
        std::minmax_element(particles.position.begin(), particles.position.end(),
                            [a](const Point<Dim>& x, const Point<Dim>& y) { return x[a] < y[a]; });
    const double extent = (*high)[a] - (*low)[a];
    if (!(extent < given * (1.0 - 1e-9))) {
      invalid_input({fmt::format("particles that lie within one period along {}, {:.6g} m", "xyz"[a], given),
                     fmt::format("an extent of {:.6g} m", extent),
                     "leave out particles that are images of others, or lengthen the period", spec.where});
    }
    period[a] = given;
  }
  return period;
}

template <int Dim>
Bonds<Dim> make_bonds(const Model& model, const Particles<Dim>& particles) {
  const HorizonSpec& h = model.horizon;
  if (!(h.value > 0.0)) {
    invalid_input({"body.horizon > 0", fmt::format("{}", h.value), "give {ratio: 3}", h.where});
  }
  try {
    if (particles.grid) {
      const double spacing = particles.grid->spacing;
      if (h.rule == HorizonSpec::Rule::neighbours) {
        invalid_input({"horizon {ratio} or {length} for a grid", "{neighbours}",
                       "neighbours belong to clouds", h.where});
      }
      const double delta = h.rule == HorizonSpec::Rule::ratio ? h.value * spacing : h.value;
      return make_grid_bonds(particles,
                             make_family<Dim>(spacing, delta, model.volume_correction, model.self_cell),
                             beyond_faces<Dim>(model.boundary, model.periodic));
    }
    if (h.rule == HorizonSpec::Rule::ratio) {
      invalid_input(
          {"horizon {length} or {neighbours} for a cloud", "{ratio}", "a cloud has no spacing", h.where});
    }
    const bool walls = std::any_of(model.boundary.begin(), model.boundary.end(),
                                   [](const auto& c) { return std::holds_alternative<Wall>(c.what); });
    if (walls) {
      invalid_input({"a grid where there are walls", "a cloud", "use a grid, or fix regions of the cloud",
                     std::get<CloudSpec>(model.particles).where});
    }
    const Point<Dim> period = cloud_period(model, particles);
    std::vector<double> horizon(particles.count(), h.value);
    if (h.rule == HorizonSpec::Rule::neighbours)
      horizon = cloud_horizons(particles, static_cast<int>(h.value), period);
    return make_cloud_bonds(particles, horizon, model.volume_correction, section_of(model), period);
  } catch (const Error& error) {
    throw at(error, h.where);
  }
}

struct BlockMaterial {
  Material material;
  double energy;  ///< of unit dilation, Pa
};

/// c_i(r) tables and calibration factors, docs/theory/02_micromoduli.md.
template <int Dim>
void set_kernels(BondConstants& constants, const Body<Dim>& body, const std::vector<BlockMaterial>& blocks,
                 const Continuum& continuum) {
  if (const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds)) {
    const Family<Dim>& f = grid->family;
    constants.family_size = f.size();
    for (const auto& block : blocks) {
      const auto& m = block.material;
      const double c0 = micromodulus_constant(m.micromodulus, m.youngs_modulus, f.horizon, continuum);
      try {
        for (const double shape : kernel_shapes(m.micromodulus, f)) constants.kernel.push_back(c0 * shape);
      } catch (const Error& error) {
        throw at(error, m.where);
      }
    }
    return;
  }
  const auto& cloud = std::get<CloudBonds<Dim>>(body.bonds);
  constants.kernel_of_end.resize(cloud.neighbour.size());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < body.count(); ++i) {
    const Material& m = blocks[body.particles.block[i]].material;
    double horizon = -1.0;
    double c0 = 0.0;
    for_each_bond(cloud, i, Which::present, [&](const BondEnd<Dim>& end) {
      if (end.horizon != horizon) {
        horizon = end.horizon;
        c0 = micromodulus_constant(m.micromodulus, m.youngs_modulus, horizon, continuum);
      }
      constants.kernel_of_end[end.slot] = micromodulus(m.micromodulus, c0, end.length, end.horizon);
    });
  }
}

template <int Dim>
double own_kernel(const Body<Dim>& body, const BondConstants& constants, Index i, Offset slot) {
  return constants.kernel.empty() ? constants.kernel_of_end[slot]
                                  : constants.kernel[body.particles.block[i] * constants.family_size + slot];
}

template <int Dim>
bool alive(const Bonds<Dim>& bonds, Index i, Offset slot) {
  return std::visit([&](const auto& b) { return is_alive(b, i, slot); }, bonds);
}

/// f_i = W / ((1/4) sum_j c_i(r) beta r V_j): the family stores the continuum energy of pure dilation.
template <int Dim>
void calibrate(BondConstants& constants, const Body<Dim>& body, const std::vector<BlockMaterial>& blocks,
               bool without_cut, const Where& where) {
  const Index n = body.count();
  constants.factor.assign(n, 1.0);
  Index lonely = -1;
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < n; ++i) {
    double energy = 0.0;
    for_each_bond(body.bonds, i, Which::present, [&](const BondEnd<Dim>& end) {
      // A particle's bond to its own periodic image carries no force, so it has no alive bit, but counts.
      if (without_cut && end.neighbour != i && !alive(body.bonds, i, end.slot)) return;
      const Index j = owner(body.bonds, end.neighbour, n);
      energy += 0.25 * own_kernel(body, constants, i, end.slot) * end.weight * end.length *
                body.particles.volume[j];
    });
    if (energy > 0.0) {
      constants.factor[i] = blocks[body.particles.block[i]].energy / energy;
    } else {
#pragma omp atomic write
      lonely = i;
    }
  }
  if (lonely >= 0) {
    invalid_input({"at least one bond at every particle for calibration discrete",
                   fmt::format("none at particle {}", lonely),
                   "use calibration continuum or a longer horizon", where});
  }
}

/// The harmonic mean of a negative and a positive micromodulus is no stiffness of two springs in series.
template <int Dim>
void require_equal_signs(const Body<Dim>& body, const std::vector<BlockMaterial>& blocks) {
  const auto* grid = std::get_if<GridBonds<Dim>>(&body.bonds);
  if (grid == nullptr || blocks.size() < 2 || !softening(body)) return;
  const auto& block = body.particles.block;
  const std::vector<double>& kernel = body.constants.kernel;
  const auto size = static_cast<std::size_t>(body.constants.family_size);
  for (Index i = 0; i < body.count(); ++i) {
    for_each_bond(*grid, i, Which::alive, [&](const BondEnd<Dim>& end) {
      const Index j = owner(body.bonds, end.neighbour, body.count());
      const auto member = static_cast<std::size_t>(end.slot);
      const double ci = kernel[static_cast<std::size_t>(block[i]) * size + member];
      const double cj = kernel[static_cast<std::size_t>(block[j]) * size + member];
      if (block[i] == block[j] || (ci < 0.0) == (cj < 0.0) || ci == 0.0 || cj == 0.0) return;
      const std::size_t negative = static_cast<std::size_t>(ci < 0.0 ? block[i] : block[j]);
      invalid_input({"micromoduli of one sign for the bonds between two blocks",
                     fmt::format("{:.4g} and {:.4g} N/m6 at bonds of length {:.6g} m", ci, cj, end.length),
                     "use kernels of one sign in blocks that touch, or one material",
                     blocks[negative].material.where});
    });
  }
}

}  // namespace

template <int Dim>
Body<Dim> build_body(const Model& model, const Sink& sink) {
  if (model.dimension != Dim) {
    invalid_input({fmt::format("a model of dimension {}", Dim), fmt::format("{}", model.dimension),
                   "build the body for the model's dimension", model.where});
  }
  require_lattice_kernel_fits(model);
  require_positive(section_of(model), Dim == 1 ? "body.area" : "body.thickness", model.where);
  sink.report("particles");
  Body<Dim> body;
  body.section = section_of(model);
  body.particles = make_particles<Dim>(model);
  sink.report("bonds");
  body.bonds = make_bonds(model, body.particles);

  const Continuum continuum{Dim, model.plane, body.section};
  std::vector<BlockMaterial> blocks;
  for (const auto& name : body.particles.block_names) {
    const auto it = model.block_materials.find(name);
    const Material& m = it == model.block_materials.end() ? model.material : it->second;
    require_positive(m.youngs_modulus, "youngs_modulus", m.where);
    require_positive(m.density, "density", m.where);
    blocks.push_back({m, dilation_energy(m.youngs_modulus, continuum)});
    body.density.push_back(m.density);
  }
  for (const auto& [name, material] : model.block_materials) {
    const auto& names = body.particles.block_names;
    if (std::find(names.begin() + 1, names.end(), name) == names.end()) {
      invalid_input({"materials of blocks the body has", fmt::format("'{}'", name),
                     "define the block in body.blocks", material.where});
    }
  }

  const auto cracks = precracks<Dim>(model);
  const double spacing = typical_spacing(body.particles, body.section);
  set_kernels(body.constants, body, blocks, continuum);
  if (model.calibration == Calibration::discrete) {
    calibrate(body.constants, body, blocks, false, model.material.where);
  }
  body.cut = cut_bonds(body.bonds, body.particles, cracks, spacing);
  if (model.calibration == Calibration::discrete_cut) {
    calibrate(body.constants, body, blocks, true, model.material.where);
  }
  require_equal_signs(body, blocks);
  sink.report("boundary");
  body.boundary = make_boundary_map<Dim>(
      body.particles, body.bonds, model.boundary,
      [&body](Index i, const BondEnd<Dim>& end) { return bond_stiffness(body, i, end); });
  return body;
}

template <int Dim>
double bond_stiffness(const Body<Dim>& body, Index i, const BondEnd<Dim>& end) {
  const Index j = owner(body.bonds, end.neighbour, body.count());
  const auto& constants = body.constants;
  const auto& block = body.particles.block;
  double ci = 0.0;
  double cj = 0.0;
  if (!constants.kernel.empty()) {
    ci = constants.kernel[block[i] * constants.family_size + end.slot];
    cj = constants.kernel[block[j] * constants.family_size + end.slot];
  } else {
    const auto& cloud = std::get<CloudBonds<Dim>>(body.bonds);
    const auto row = cloud.neighbour.begin() + cloud.start[j];
    ci = constants.kernel_of_end[end.slot];
    cj =
        block[i] == block[j]
            ? ci
            : constants.kernel_of_end[std::lower_bound(row, cloud.neighbour.begin() + cloud.start[j + 1], i) -
                                      cloud.neighbour.begin()];
  }
  if (!constants.factor.empty()) {
    ci *= constants.factor[i];
    cj *= constants.factor[j];
  }
  double c = 0.5 * (ci + cj);
  if (block[i] != block[j]) c = ci * cj > 0.0 ? 2.0 * (ci * cj) / (ci + cj) : 0.0;
  return c * end.weight * (body.particles.volume[i] * body.particles.volume[j]) / end.length;
}

BodySize estimate_size(const Model& model) {
  BodySize size;
  const auto* spec = std::get_if<GridSpec>(&model.particles);
  if (spec == nullptr) return size;
  size.particles = 1.0;
  for (std::size_t a = 0; a < spec->lower.size() && a < spec->upper.size(); ++a) {
    size.particles *= std::round((spec->upper[a] - spec->lower[a]) / spec->spacing);
  }
  const double ratio = model.horizon.rule == HorizonSpec::Rule::ratio ? model.horizon.value
                                                                      : model.horizon.value / spec->spacing;
  const double pi = 3.14159265358979323846;
  size.family = model.dimension == 1   ? 2.0 * ratio
                : model.dimension == 2 ? pi * ratio * ratio
                                       : 4.0 / 3.0 * pi * std::pow(ratio, 3);
  return size;
}

#define PERIMODE_BODY(D)                                     \
  template Body<D> build_body<D>(const Model&, const Sink&); \
  template double bond_stiffness<D>(const Body<D>&, Index, const BondEnd<D>&)
PERIMODE_BODY(1);
PERIMODE_BODY(2);
PERIMODE_BODY(3);
#undef PERIMODE_BODY

}  // namespace perimode
