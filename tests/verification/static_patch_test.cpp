// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/assembly/fields.hpp"
#include "perimode/assembly/operators.hpp"
#include "verification/held_body.hpp"

namespace perimode {
namespace {

using test::add_wall;
using test::box_model;
using test::hold_outer_layers;
using test::solve_held;

constexpr Kernel kernels[] = {Kernel::constant, Kernel::conical, Kernel::gaussian, Kernel::inverse_distance};

/// Largest error of the displacement over the largest displacement, for a uniform gradient given on the outer
/// layers.
template <int Dim>
double patch_error(const Model& model, int layers) {
  auto body = build_body<Dim>(model);
  Eigen::Matrix<double, Dim, Dim> h;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) h(a, b) = 1e-3 * (2.0 - a + 3.0 * b * a - 1.5 * b);
  }
  hold_outer_layers(body, layers, [&](const Point<Dim>& x) -> Point<Dim> { return h * x; });
  EXPECT_GT(body.boundary.free, 0);
  const StaticResult r = solve_held(body);
  double error = 0.0;
  for (Index i = 0; i < body.count(); ++i) {
    const Point<Dim> u = r.displacement.template segment<Dim>(Dim * i);
    error = std::max(error, (u - h * body.particles.position[i]).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(r.balance, 1e-12);
  EXPECT_NEAR(r.strain_energy, r.external_work, 1e-11 * r.strain_energy);
  return error / r.displacement.cwiseAbs().maxCoeff();
}

/// A uniform strain leaves no net force on a whole family whose bonds of one length are all alike, since they
/// come in opposite pairs. Under calibration continuum that is every particle with a whole family: a layer
/// as deep as the horizon is held. Under calibration discrete the factors of the partners count too, and they
/// are alike where the partners' families are whole as well: twice as deep.
template <int Dim>
void expect_patch(const std::vector<int>& cells, double ratio, int reach) {
  for (Kernel kernel : kernels) {
    for (VolumeCorrection correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
      Model m = box_model(cells, 0.1, ratio);
      m.material.micromodulus.kernel = kernel;
      m.volume_correction = correction;
      EXPECT_LE(patch_error<Dim>(m, reach), 1e-12);
      m.calibration = Calibration::discrete;
      EXPECT_LE(patch_error<Dim>(m, 2 * reach), 1e-12);
    }
  }
}

TEST(Patch, AUniformStrainIsReproducedInTheInterior) {
  expect_patch<1>({30}, 3.0, 3);
  expect_patch<2>({18, 16}, 3.0, 3);
  expect_patch<3>({9, 10, 9}, 2.0, 2);
}

TEST(Patch, UnevenFactorsBesideTheFaceDisturbIt) {
  Model m = box_model({20, 18}, 0.1, 3.0);
  m.calibration = Calibration::discrete;
  const double error = patch_error<2>(m, 3);
  EXPECT_GT(error, 1e-4);
  EXPECT_LT(error, 1e-2);
}

/// Surface nodes on every face not named otherwise, with u_s = h x: extrapolation is exact, so every family
/// is whole and its neighbours move as h x. Statically and as no acceleration.
template <int Dim>
void expect_surface_patch(const Model& model, const Eigen::Matrix<double, Dim, Dim>& h) {
  const auto body = build_body<Dim>(model);
  Eigen::VectorXd exact(body.count() * Dim);
  for (Index i = 0; i < body.count(); ++i) exact.segment<Dim>(i * Dim) = h * body.particles.position[i];
  const double size = exact.cwiseAbs().maxCoeff();
  // Rows of the largest absolute sum; extrapolated displacements are at most three times the largest one.
  const double force = stiffness_bound(body) * size;
  EXPECT_LE(internal_force(body, exact).cwiseAbs().maxCoeff(), 1e-13 * force);
  StaticOptions options;
  options.tolerance = 1e-12;
  const StaticResult r = solve_static(body, model.boundary, options);
  ASSERT_EQ(r.status, StaticStatus::converged) << r.message;
  EXPECT_LE((r.displacement - exact).cwiseAbs().maxCoeff(), 1e-12 * size);
}

template <int Dim>
Eigen::Matrix<double, Dim, Dim> patch_gradient() {
  Eigen::Matrix<double, Dim, Dim> h;
  for (int a = 0; a < Dim; ++a) {
    for (int b = 0; b < Dim; ++b) h(a, b) = 1e-3 * (2.0 - a + 3.0 * b * a - 1.5 * b);
  }
  return h;
}

template <int Dim>
void expect_surface_patches(const std::vector<int>& cells, int ratio) {
  const auto h = patch_gradient<Dim>();
  for (Kernel kernel : kernels) {
    for (VolumeCorrection correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
      Model m = box_model(cells, 0.1, ratio);
      m.material.micromodulus.kernel = kernel;
      m.volume_correction = correction;
      for (int a = 0; a < Dim; ++a) {
        for (bool upper : {false, true}) test::add_surface_nodes(m, a, upper, test::linear_field<Dim>(h));
      }
      expect_surface_patch<Dim>(m, h);
      m.calibration = Calibration::discrete;  // ghosts count, so that all factors are alike
      expect_surface_patch<Dim>(m, h);
    }
  }
}

TEST(SurfaceNodes, AUniformStrainIsReproducedToTheCorners) {
  for (int ratio : {2, 3, 4}) {
    expect_surface_patches<1>({12}, ratio);
    expect_surface_patches<2>({11, 7}, ratio);
  }
  expect_surface_patches<3>({5, 6, 4}, 2);
  expect_surface_patches<3>({4, 6, 5}, 3);
}

TEST(SurfaceNodes, AUniformStrainIsReproducedAtTheLongestHorizon) {
  const auto h = patch_gradient<3>();
  Model m = box_model({5, 6, 7}, 0.1, 4.0);
  m.volume_correction = VolumeCorrection::linear;
  for (int a = 0; a < 3; ++a) {
    for (bool upper : {false, true}) test::add_surface_nodes(m, a, upper, test::linear_field<3>(h));
  }
  expect_surface_patch<3>(m, h);
}

TEST(SurfaceNodes, AUniformStrainIsReproducedBesideMirrorsAndPeriodicAxes) {
  for (int ratio : {2, 3}) {
    Eigen::Matrix2d stretched = Eigen::Vector2d(2e-3, -1e-3).asDiagonal();
    Model plate = box_model({9, 6}, 0.1, ratio);
    test::add_surface_nodes(plate, 1, true, test::linear_field<2>(stretched));
    test::add_surface_nodes(plate, 0, true, test::linear_field<2>(stretched));
    add_wall(plate, 0, false, WallType::mirror);
    add_wall(plate, 1, false, WallType::mirror);
    expect_surface_patch<2>(plate, stretched);

    Eigen::Matrix3d along = Eigen::Matrix3d::Zero();
    along.col(0) << 2e-3, 1e-3, -3e-3;
    Model block = box_model({5, 4, 3}, 0.1, ratio);
    block.periodic = {false, true, true};
    for (bool upper : {false, true}) test::add_surface_nodes(block, 0, upper, test::linear_field<3>(along));
    expect_surface_patch<3>(block, along);
  }
}

/// A bar between an odd wall and surface nodes that move by U: both let a linear field through, so the bar is
/// linear to the last particle and its force that of the lattice, (E' / E) E A U / L.
TEST(Bar, IsLinearAndAsStiffAsItsLattice) {
  for (int m = 1; m <= 5; ++m) {
    for (VolumeCorrection correction : {VolumeCorrection::none, VolumeCorrection::linear}) {
      Model model = box_model({40}, 0.05, m);
      model.area = 0.3;
      model.material.youngs_modulus = 7.0;
      model.volume_correction = correction;
      const double end = 1e-3;
      add_wall(model, 0, false, WallType::odd);
      test::add_surface_nodes(model, 0, true, {std::to_string(end)});
      StaticOptions options;
      options.tolerance = 1e-12;
      const StaticResult r = solve_static(build_body<1>(model), model.boundary, options);
      ASSERT_EQ(r.status, StaticStatus::converged) << r.message;
      for (int i = 0; i < 40; ++i) EXPECT_NEAR(r.displacement[i], end * (i + 0.5) / 40, 1e-12 * end);
      // E'/E = (2 / m^2) sum beta k: 1 + 1/m without correction, 1 where the last bond counts half.
      const double lattice = correction == VolumeCorrection::linear ? 1.0 : 1.0 + 1.0 / m;
      const double force = lattice * 7.0 * 0.3 * end / 2.0;
      EXPECT_NEAR(r.reactions[0].force[0], -force, 1e-11 * force);
      EXPECT_NEAR(r.reactions[1].force[0], force, 1e-11 * force);
    }
  }
}

/// A bar held by surface nodes at x- and pulled by a traction of those at x+: u = (sigma / E') x to the last
/// particle, E'/E = 1 for the constant kernel whose last bond counts half, and the force is sigma A.
TEST(Bar, IsLinearUnderASurfaceTraction) {
  for (int m = 1; m <= 6; ++m) {
    for (Kernel kernel : kernels) {
      if (m == 1 && kernel == Kernel::conical) continue;  // its only bond has c(delta) = 0
      Model model = box_model({30}, 0.05, m);
      model.area = 0.3;
      model.material.youngs_modulus = 7.0;
      model.material.micromodulus.kernel = kernel;
      model.volume_correction = VolumeCorrection::linear;
      test::add_surface_nodes(model, 0, false);
      test::add_surface_traction(model, true, 0.014);
      const auto body = build_body<1>(model);
      double modulus = 0.0;  // E' = 1 / (2 V) sum_b k_b xi^2 of a whole family
      for_each_bond(body.bonds, 15, Which::alive, [&](const BondEnd<1>& end) {
        modulus +=
            bond_stiffness(body, 15, end) * end.length * end.length / (2.0 * body.particles.volume[15]);
      });
      if (kernel == Kernel::constant) {
        EXPECT_NEAR(modulus, 7.0, 1e-13 * 7.0);
      }
      StaticOptions options;
      options.tolerance = 1e-12;
      const StaticResult r = solve_static(body, model.boundary, options);
      ASSERT_EQ(r.status, StaticStatus::converged) << r.message;
      const double strain = 0.014 / modulus;
      for (int i = 0; i < 30; ++i)
        EXPECT_NEAR(r.displacement[i], strain * 0.05 * (i + 0.5), 1e-12 * strain * 1.5);
      EXPECT_NEAR(r.reactions[0].force[0], -0.014 * 0.3, 1e-11 * 0.014 * 0.3);
      EXPECT_NEAR(r.reactions[1].force[0], 0.014 * 0.3, 1e-11 * 0.014 * 0.3);
    }
  }
}

TEST(Bar, BetweenTwoSurfaceTractionsIsNotHeld) {
  Model model = box_model({30}, 0.05, 3.0);
  for (bool upper : {false, true}) test::add_surface_traction(model, upper, 1.0);
  EXPECT_THROW((void)solve_static(build_body<1>(model), model.boundary, StaticOptions{}), Error);
}

/// A strip between mirror walls at x-, y- and y+, and a given uniform strain in the layers at x+.
TEST(Strip, IsLinearAndItsReactionIsTheLatticeStressTimesItsSection) {
  for (Kernel kernel : kernels) {
    Model model = box_model({24, 6}, 0.1, 3.0);
    model.thickness = 0.2;
    model.material.micromodulus.kernel = kernel;
    model.volume_correction = VolumeCorrection::linear;
    add_wall(model, 0, false, WallType::mirror);
    add_wall(model, 1, false, WallType::mirror);
    add_wall(model, 1, true, WallType::mirror);
    auto body = build_body<2>(model);
    const double strain_x = 2e-3;
    BoundaryMap<2>& map = body.boundary;
    map.free = 0;
    for (std::size_t d = 0; d < map.free_number.size(); ++d) {
      const double x = body.particles.position[d / 2][0];
      const bool held = x > 2.4 - 0.4;
      map.free_number[d] = held ? -1 : map.free++;
      map.given[d] = held && d % 2 == 0 ? strain_x * x : 0.0;
    }
    const StaticResult r = solve_static(body, model.boundary, StaticOptions{});
    ASSERT_EQ(r.status, StaticStatus::converged) << r.message;
    for (Index i = 0; i < body.count(); ++i) {
      EXPECT_NEAR(r.displacement[2 * i], strain_x * body.particles.position[i][0], 1e-14);
      EXPECT_NEAR(r.displacement[2 * i + 1], 0.0, 1e-14);
    }
    const double sigma = stress(body, r.displacement)(0, 3 * 24 + 8);
    EXPECT_NEAR(r.reactions[0].force[0], -sigma * 0.6 * 0.2, 1e-11 * sigma);
    EXPECT_NEAR(r.strain_energy, r.external_work, 1e-11 * r.strain_energy);
  }
}

/// A bar clamped in m layers at one end and pulled at the last layer, against E A / L: the error of its
/// stiffness falls with the spacing.
TEST(Bar, UnderTractionTendsToHooke) {
  double before = 1.0;
  for (int n : {50, 100, 200, 400}) {
    Model model = box_model({n}, 1.0 / n, 3.0);
    model.volume_correction = VolumeCorrection::linear;
    test::fix_face(model, 0, false, 3, {0});
    StaticOptions options;
    options.loads = {{Traction{{1.0}}, Region{FaceRegion{{0, true}, 1, 0.0}, {}}}};
    const StaticResult r = solve_static(build_body<1>(model), model.boundary, options);
    ASSERT_EQ(r.status, StaticStatus::converged) << r.message;
    const double error = std::abs(2.0 * r.strain_energy - 1.0);  // U = sigma^2 A L / (2 E)
    EXPECT_LT(error, 0.6 * before);
    before = error;
  }
  EXPECT_LT(before, 0.01);
}

/// Half a plate with a hole and a crack at a mirror wall, and the whole one.
TEST(Mirror, HalfABodyStandsForTheWhole) {
  const auto make = [](double lower, bool half) {
    Model m = box_model({half ? 12 : 24, 14}, 0.1, 3.0);
    auto& grid = std::get<GridSpec>(m.particles);
    grid.lower = {lower, 0.0};
    grid.upper = {1.2, 1.4};
    grid.remove = {{BallRegion{{0.0, 0.5}, 0.3}, {}}};
    m.calibration = Calibration::discrete;
    m.volume_correction = VolumeCorrection::linear;
    test::add_crack(m, {{0.6, 0.0}, {0.8, 0.6}});
    if (!half) test::add_crack(m, {{-0.8, 0.6}, {-0.6, 0.0}});
    if (half) add_wall(m, 0, false, WallType::mirror);
    test::fix_face(m, 1, false, 2, {0, 1});
    return m;
  };
  StaticOptions options;
  options.tolerance = 1e-12;
  options.loads = {{Traction{{0.0, 1e-3}}, Region{FaceRegion{{1, true}, 2, 0.0}, {}}}};
  const Model half_model = make(0.0, true);
  const Model whole_model = make(-1.2, false);
  const auto half = build_body<2>(half_model);
  const auto whole = build_body<2>(whole_model);
  ASSERT_EQ(whole.count(), 2 * half.count());
  const StaticResult a = solve_static(half, half_model.boundary, options);
  const StaticResult b = solve_static(whole, whole_model.boundary, options);
  const double scale = b.displacement.cwiseAbs().maxCoeff();
  for (Index i = 0; i < half.count(); ++i) {
    const Region here{NearestRegion{{half.particles.position[i][0], half.particles.position[i][1]}}, {}};
    const Index j = select(here, whole.particles).front();
    EXPECT_LE((a.displacement.segment<2>(2 * i) - b.displacement.segment<2>(2 * j)).norm(), 1e-11 * scale);
  }
  EXPECT_NEAR(2.0 * a.strain_energy, b.strain_energy, 1e-11 * b.strain_energy);
  EXPECT_NEAR(2.0 * a.reactions[1].force[1], b.reactions[0].force[1], 1e-11 * 2.4e-3);
}

}  // namespace
}  // namespace perimode
