// SPDX-License-Identifier: BSD-3-Clause
#include "studies/common/release.hpp"

#include <cmath>
#include <limits>

#include "perimode/dispersion/symbol.hpp"
#include "perimode/dynamics/transient.hpp"

namespace perimode::studies {
namespace {

TransientProbe strain_across(const Body<1>& bar, double x) {
  const double half = 0.5 * bar.particles.grid->spacing;
  TransientProbe probe;
  probe.name = "strain";
  probe.kind = TransientProbe::Kind::strain;
  probe.at = {x - half};
  probe.to = {x + half};
  return probe;
}

void require_done(const TransientResult& result) {
  if (result.status != TransientStatus::done) throw Error(ErrorKind::solver_failure, result.message);
}

template <int Dim>
DispersionRelation relation(const Model& model) {
  const auto& grid = std::get<GridSpec>(model.particles);
  const double section = Dim == 1 ? model.area : (Dim == 2 ? model.thickness : 1.0);
  const Medium medium = {model.material, {Dim, model.plane, section}, model.horizon.value * grid.spacing};
  Family<Dim> family =
      make_family<Dim>(grid.spacing, medium.horizon, model.volume_correction, model.self_cell);
  std::vector<double> rates = bond_rates<Dim>(medium, family, model.calibration);
  return [family = std::move(family), rates = std::move(rates)](double k) {
    Point<Dim> wave = Point<Dim>::Zero();
    wave[0] = k;
    return std::sqrt(lattice_symbol<Dim>(family, rates, wave)(0, 0));
  };
}

}  // namespace

template <int Dim>
Eigen::VectorXd along_x(const Body<Dim>& body, const std::function<double(double)>& u) {
  Eigen::VectorXd field = Eigen::VectorXd::Zero(Dim * static_cast<Eigen::Index>(body.count()));
  for (Index i = 0; i < body.count(); ++i)
    field[Dim * static_cast<Eigen::Index>(i)] = u(body.particles.position[static_cast<std::size_t>(i)][0]);
  return field;
}

template <int Dim>
std::vector<Eigen::VectorXd> release(Body<Dim>& body, const Eigen::VectorXd& u0, double dt,
                                     const std::vector<double>& times) {
  TransientOptions options;
  options.dt = dt;
  options.end = times.back();
  options.history_every = std::numeric_limits<int>::max();
  options.fields_at = times;
  std::vector<Eigen::VectorXd> fields;
  TransientObserver<Dim> observer;
  observer.fields = [&](const TransientFrame<Dim>& frame) { fields.push_back(frame.displacement); };
  require_done(run_transient<Dim>(body, options, {u0, {}}, observer));
  return fields;
}

std::vector<double> strain_history(Body<1>& bar, const Eigen::VectorXd& u0, double dt, double end, int every,
                                   double x) {
  TransientOptions options;
  options.dt = dt;
  options.end = end;
  options.history_every = every;
  options.probes = {strain_across(bar, x)};
  std::vector<double> strain;
  TransientObserver<1> observer;
  observer.history = [&](const HistoryRow& row) { strain.push_back(row.probes[0]); };
  require_done(run_transient<1>(bar, options, {u0, {}}, observer));
  return strain;
}

DispersionRelation lattice_relation(const Model& model) {
  if (model.dimension == 1) return relation<1>(model);
  return model.dimension == 2 ? relation<2>(model) : relation<3>(model);
}

DispersionRelation stepped_relation(const Model& model, double dt) {
  return [omega = lattice_relation(model), dt](double k) { return stepped_frequency(omega(k), dt); };
}

template Eigen::VectorXd along_x<1>(const Body<1>&, const std::function<double(double)>&);
template Eigen::VectorXd along_x<3>(const Body<3>&, const std::function<double(double)>&);
template std::vector<Eigen::VectorXd> release<1>(Body<1>&, const Eigen::VectorXd&, double,
                                                 const std::vector<double>&);
template std::vector<Eigen::VectorXd> release<3>(Body<3>&, const Eigen::VectorXd&, double,
                                                 const std::vector<double>&);

}  // namespace perimode::studies
