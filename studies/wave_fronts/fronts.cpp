// SPDX-License-Identifier: BSD-3-Clause
#include "fronts.hpp"

#include <cmath>
#include <limits>

#include "perimode/dynamics/transient.hpp"

namespace perimode::studies {

Front front_of(const KernelWaves& kernel, const PointSource& source, double dt) {
  const Medium& medium = kernel.lattice.medium;
  PointForce exact;
  exact.density = medium.material.density;
  exact.pressure_speed = classical_speed(medium, Branch::pressure);
  exact.shear_speed = classical_speed(medium, Branch::shear);
  exact.force = Point<3>(0.0, 0.0, 1.0);
  exact.frequency = exact.shear_speed / source.wavelength;

  const double peak = 1.5 / exact.frequency;
  Front front;
  front.cells = source.cells;
  front.time = dt * std::round((peak + source.travelled / exact.shear_speed) / dt);
  front.dt = dt;
  // The wavelet swells from a thousandth at a third of the time of its peak: pressure waves that left the
  // images of the source then have come as far as here.
  front.reach = source.cells - exact.pressure_speed * (front.time - peak / 3.0);

  TransientOptions options;
  options.dt = dt;
  options.end = front.time;
  options.history_every = std::numeric_limits<int>::max();
  Load load;
  load.what = TotalForce{{0.0, 0.0, 1.0}};
  load.at = Region{NearestRegion{{0.0, 0.0, 0.0}}, {}};
  load.time.kind = TimeFunction::Kind::ricker;
  load.time.a = exact.frequency;
  options.loads = {load};
  Body<3> body = build_body<3>(solid(kernel.ratio, source.cells, kernel.kernel));
  const TransientResult result = run_transient<3>(body, options, {});
  if (result.status != TransientStatus::done) throw Error(ErrorKind::solver_failure, result.message);
  front.steps = result.step;
  front.seconds = result.seconds_steps;

  double difference = 0.0, size = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    const Point<3>& x = body.particles.position[static_cast<std::size_t>(i)];
    if (std::abs(x[1]) > 0.25) continue;
    const double r = x.norm();
    const Point<3> u = result.displacement.segment<3>(3 * static_cast<Eigen::Index>(i));
    const Point<3> classical = r > 0.25 ? displacement_of_force(exact, x, front.time)
                                        : Point<3>::Constant(std::numeric_limits<double>::quiet_NaN());
    front.position.push_back(x);
    front.displacement.push_back(u);
    front.exact.push_back(classical);
    if (r < source.wavelength || r > front.reach) continue;
    // weighted by the circle around z that the place stands for
    difference += std::abs(x[0]) * (u - classical).squaredNorm();
    size += std::abs(x[0]) * classical.squaredNorm();
  }
  front.error = std::sqrt(difference / size);
  return front;
}

}  // namespace perimode::studies
