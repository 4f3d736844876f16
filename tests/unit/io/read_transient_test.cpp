// SPDX-License-Identifier: BSD-3-Clause
#include "unit/io/bad_case.hpp"

namespace perimode {
namespace {

using test::replace_line;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// A sample case with `section` as its analysis.transient.
Case read_transient(const std::string& section, const char* base = "plate",
                    const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  (void)folder.write("cloud.csv", test::sample_cloud());
  (void)folder.write("u0.csv", "x,y\n0,0\n");
  (void)folder.write("modes.exo", "");
  const std::string line = "analysis: { transient: " + section + " }";
  return read_case(folder.write("case.yaml", replace_line(test::sample_cases().at(base), "analysis", line)),
                   overrides);
}

TransientOptions options(const std::string& section, const char* base = "plate",
                         const std::vector<std::string>& overrides = {}) {
  return read_transient(section, base, overrides).transient.value();
}

TEST(ReadTransient, TheEndAloneIsEnough) {
  const Case c = read_transient("{ end: 1.0e-3 }");
  ASSERT_TRUE(c.transient.has_value());
  const TransientOptions& o = *c.transient;
  EXPECT_EQ(o.method, TimeMethod::central_difference);
  EXPECT_EQ(o.dt, 0.0);
  EXPECT_EQ(o.end, 1e-3);
  EXPECT_EQ(o.history_every, 1);
  EXPECT_EQ(o.fields_every, 0);
  EXPECT_EQ(o.checkpoint_every, 0);
  EXPECT_TRUE(o.loads.empty());
  EXPECT_TRUE(o.probes.empty());
  EXPECT_FALSE(o.sponge.has_value());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(c.initial.displacement));
  EXPECT_EQ(c.transient_where.line, 20);
  EXPECT_EQ(o.where.line, 20);
  EXPECT_FALSE(c.modal.has_value());
}

TEST(ReadTransient, StepsOutputsAndOperator) {
  const TransientOptions o = options(
      "{ dt: 1.0e-7, end: 1.0e-3, operator: assembled, history_every: 5, checkpoint_every: 1000, "
      "fields_at: [1.0e-3, 0, 5.0e-4] }");
  EXPECT_EQ(o.dt, 1e-7);
  EXPECT_EQ(o.form, StiffnessForm::blocks);
  EXPECT_EQ(o.history_every, 5);
  EXPECT_EQ(o.checkpoint_every, 1000);
  EXPECT_THAT(o.fields_at, ElementsAre(0.0, 5e-4, 1e-3));
  EXPECT_EQ(options("{ dt: auto, end: 1, fields_every: 7 }").fields_every, 7);
  EXPECT_EQ(options("{ dt: auto, end: 1 }").dt, 0.0);
}

TEST(ReadTransient, MethodsHaveTheirParameters) {
  const TransientOptions newmark = options("{ method: newmark, end: 1, beta: 0.3, gamma: 0.6, solver: cg }");
  EXPECT_EQ(newmark.method, TimeMethod::newmark);
  EXPECT_EQ(newmark.newmark.beta, 0.3);
  EXPECT_EQ(newmark.newmark.gamma, 0.6);
  EXPECT_EQ(newmark.newmark.alpha, 0.0);
  EXPECT_EQ(newmark.solver, ImplicitSolver::cg);
  EXPECT_EQ(newmark.tolerance, 1e-12);
  const TransientOptions hht = options("{ method: hht, end: 1, alpha: -0.2, tolerance: 1e-9 }");
  EXPECT_EQ(hht.method, TimeMethod::hht);
  EXPECT_EQ(hht.newmark.alpha, -0.2);
  EXPECT_EQ(hht.tolerance, 1e-9);
  EXPECT_EQ(options("{ method: hht, end: 1 }").newmark.alpha, -0.1);
  EXPECT_EQ(options("{ method: hht, end: 1, alpha: -0.33333333333333333 }").newmark.alpha, -1.0 / 3.0);
  EXPECT_EQ(options("{ method: modal, end: 1, modes: 40 }").modes, 40);
}

TEST(ReadTransient, InitialStates) {
  const InitialSpec formulas =
      read_transient(
          "{ end: 1, initial: { displacement: [\"1e-3*sin(2*pi*x)\", 0.1], velocity: [\"0\", \"x*y\"] } }")
          .initial;
  const auto& u = std::get<FormulaField>(formulas.displacement);
  ASSERT_EQ(u.component.size(), 2U);
  EXPECT_EQ(u.component[1](0.3, 0.4), 0.1);
  EXPECT_EQ(std::get<FormulaField>(formulas.velocity).component[1](3.0, 0.5), 1.5);
  EXPECT_EQ(formulas.where.line, 20);

  const Case files = read_transient(
      "{ end: 1, initial: { displacement: { file: u0.csv }, "
      "velocity: { mode: { file: modes.exo, number: 3, scale: -2 } } } }");
  EXPECT_EQ(std::get<TableField>(files.initial.displacement).file.filename(), "u0.csv");
  const auto& mode = std::get<ModeField>(files.initial.velocity);
  EXPECT_EQ(mode.file.filename(), "modes.exo");
  EXPECT_EQ(mode.mode, 3);
  EXPECT_EQ(mode.scale, -2.0);
  ASSERT_EQ(files.files.size(), 2U);
  EXPECT_EQ(files.files[0].filename(), "u0.csv");
  EXPECT_EQ(files.files[1].filename(), "modes.exo");
}

TEST(ReadTransient, LoadsDampingAndSponge) {
  const TransientOptions o = options(
      "{ end: 1, loads: [ { traction: [0, 1.0e+6], at: { face: y-, layers: 1 }, time: { ricker: 5.0e+4 } } "
      "], "
      "damping: { rayleigh: [10, 1.0e-9], nodal: [ { rate: 5, at: { block: inclusion } } ] }, "
      "sponge: { faces: [y-, y+], width: 0.1, rate: 1.0e+4, power: 2 } }");
  ASSERT_EQ(o.loads.size(), 1U);
  EXPECT_EQ(o.loads[0].time.kind, TimeFunction::Kind::ricker);
  EXPECT_EQ(o.rayleigh_mass, 10.0);
  EXPECT_EQ(o.rayleigh_stiffness, 1e-9);
  ASSERT_EQ(o.damping.size(), 1U);
  EXPECT_EQ(o.damping[0].rate, 5.0);
  EXPECT_EQ(std::get<BlockRegion>(o.damping[0].at.shape).name, "inclusion");
  ASSERT_TRUE(o.sponge.has_value());
  ASSERT_EQ(o.sponge->faces.size(), 2U);
  EXPECT_EQ(o.sponge->faces[1].axis, 1);
  EXPECT_TRUE(o.sponge->faces[1].upper);
  EXPECT_EQ(o.sponge->width, 0.1);
  EXPECT_EQ(o.sponge->rate, 1e4);
  EXPECT_EQ(o.sponge->power, 2.0);
  const Sponge usual = options("{ end: 1, sponge: { faces: [y+], width: 0.1 } }").sponge.value();
  EXPECT_EQ(usual.rate, 0.0);  // chosen by the run
  EXPECT_EQ(usual.power, 3.0);
}

TEST(ReadTransient, ProbesInTheirOrder) {
  const auto probes = options(
                          "{ end: 1, probes: { tip: { displacement_at: [1, 0.25] }, "
                          "a-1: { strain_between: [[0.4, 0.2], [0.6, 0.2]] }, v: { velocity_at: [0, 0] } } }")
                          .probes;
  ASSERT_EQ(probes.size(), 3U);
  EXPECT_EQ(probes[0].name, "tip");
  EXPECT_EQ(probes[0].kind, TransientProbe::Kind::displacement);
  EXPECT_EQ(probes[0].at, (Coordinates{1.0, 0.25}));
  EXPECT_EQ(probes[1].name, "a-1");
  EXPECT_EQ(probes[1].kind, TransientProbe::Kind::strain);
  EXPECT_EQ(probes[1].to, (Coordinates{0.6, 0.2}));
  EXPECT_EQ(probes[2].kind, TransientProbe::Kind::velocity);
  EXPECT_EQ(probes[2].where.line, 20);
}

TEST(ReadTransient, ProbesOfACloudAreLeftToTheRun) {
  EXPECT_EQ(options("{ end: 1, probes: { far: { velocity_at: [50, 0] } } }", "cloud").probes.size(), 1U);
}

TEST(ReadTransient, KinematicsOfTheCase) {
  const Case c = read_transient("{ end: 1 }", "plate", {"kinematics=large_rotation"});
  EXPECT_EQ(c.kinematics, Kinematics::large_rotation);
  EXPECT_EQ(c.transient->kinematics, Kinematics::large_rotation);
  EXPECT_EQ(options("{ end: 1 }").kinematics, Kinematics::linear);
}

TEST(ReadTransient, SurfaceNodesHaveFormulasTractionAndTime) {
  const Case plate =
      read_transient("{ end: 1 }", "plate",
                     {"boundary.1={ wall: y+, type: surface_nodes, displacement: [\"x*y\", 0], "
                      "time: { ramp: 2 } }"});
  const auto& wall = std::get<Wall>(plate.model.boundary[1].what);
  ASSERT_EQ(wall.displacement.size(), 2U);
  EXPECT_EQ(wall.displacement[0](2.0, 0.5), 1.0);
  EXPECT_EQ(wall.time.kind, TimeFunction::Kind::ramp);
  const Case bar =
      read_transient("{ end: 1 }", "bar", {"boundary.1={ wall: x+, type: surface_nodes, traction: -5 }"});
  EXPECT_EQ(std::get<Wall>(bar.model.boundary[1].what).traction, -5.0);
}

/// Everything at once, in the order of docs/case_reference.md.
TEST(ReadTransient, APlateOfEveryKindOfSection) {
  const std::string text = R"(
title: steel plate with an edge crack
body:
  dimension: 2
  plane: stress
  thickness: 1.0
  particles: { grid: { lower: [0, 0], upper: [1.0, 0.5], spacing: 0.01, remove: [ { ball: { centre: [0.2, 0.2], radius: 0.05 } } ] } }
  horizon: { ratio: 3 }
  precracks: [ { from: [0.5, 0.0], to: [0.5, 0.2] } ]
  blocks: { inclusion: { box: { lower: [0.4, 0.2], upper: [0.6, 0.3] } } }
material:
  youngs_modulus: 210.0e+9
  density: 7850
  micromodulus: { kernel: constant }
  calibration: continuum
  volume_correction: linear
  fracture_energy: 135.0
boundary:
  - { fix: [x, y], at: { face: x-, layers: 3 } }
  - { prescribe: { y: 1.0e-4 }, at: { face: y+, layers: 3 }, time: { ramp: 1.0e-3 } }
  - { wall: y-, type: mirror }
  - { wall: x+, type: surface_nodes, displacement: [0, 0] }
analysis: { modal: {}, static: {}, transient: { end: 1 }, quasistatic: {}, dispersion: {} }
output: { directory: out/plate, fields: [displacement, damage, strain, stress, energy] }
)";
  const Case c = read_case_text(text, "case.yaml");
  EXPECT_EQ(c.model.boundary.size(), 4U);
  EXPECT_EQ(std::get<Wall>(c.model.boundary[3].what).displacement.size(), 2U);
  EXPECT_EQ(c.model.material.fracture_energy, 135.0);
  EXPECT_TRUE(c.transient.has_value());
}

TEST(CanonicalCase, ForgetsCommentsLayoutAndThePlaceOfResultsOnly) {
  const auto canonical = [](const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_case_text(text, "case.yaml", overrides).canonical;
  };
  const std::string plate = test::sample_cases().at("plate");
  const std::string reference = canonical(plate);
  EXPECT_EQ(canonical(replace_line(plate, "title", "title:   'plate'   # a comment")), reference);
  EXPECT_EQ(canonical(replace_line(plate, "output", "output: { directory: elsewhere }")), reference);
  EXPECT_EQ(canonical(replace_line(plate, "output", "")), reference);
  EXPECT_EQ(canonical(plate, {"output.directory=b"}), reference);
  EXPECT_EQ(canonical(reference), reference);  // it is a case itself
  EXPECT_NE(canonical(plate, {"body.horizon.ratio=4"}), reference);
  EXPECT_NE(canonical(plate, {"output.fields=[damage]"}), reference);
  EXPECT_THAT(canonical(replace_line(plate, "title", R"(title: "a\n\"b\" \\")")),
              HasSubstr(R"("title":"a\u000a\"b\" \\")"));
}

}  // namespace
}  // namespace perimode
