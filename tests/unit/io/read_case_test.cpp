// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perimode/io/case.hpp"
#include "perimode/io/case_template.hpp"
#include "unit/io/sample_cases.hpp"
#include "unit/io/temporary_folder.hpp"

namespace perimode {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::Pair;

Case read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  (void)folder.write("cloud.csv", test::sample_cloud());
  return read_case(folder.write("case.yaml", text), overrides);
}

Case read_sample(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_text(test::sample_cases().at(name), overrides);
}

TEST(ReadCase, PlateHasEverythingOfItsBodySection) {
  const Model model = read_sample("plate").model;
  EXPECT_EQ(model.dimension, 2);
  EXPECT_EQ(model.plane, Plane::stress);
  EXPECT_EQ(model.thickness, 0.01);
  const auto& grid = std::get<GridSpec>(model.particles);
  EXPECT_THAT(grid.lower, ElementsAre(0, 0));
  EXPECT_THAT(grid.upper, ElementsAre(1, 0.5));
  EXPECT_EQ(grid.spacing, 0.1);
  EXPECT_EQ(grid.where.line, 6);
  EXPECT_EQ(model.horizon.rule, HorizonSpec::Rule::ratio);
  EXPECT_EQ(model.horizon.value, 3.0);
  EXPECT_THAT(model.periodic, ElementsAre(true, false, false));
  ASSERT_EQ(model.precracks.size(), 1U);
  EXPECT_THAT(model.precracks[0].points, ElementsAre(ElementsAre(0.5, 0), ElementsAre(0.5, 0.2)));
  EXPECT_EQ(model.precracks[0].where.column, 16);
  ASSERT_EQ(model.blocks.size(), 1U);
  EXPECT_EQ(model.blocks[0].name, "inclusion");
  EXPECT_THAT(std::get<BoxRegion>(model.blocks[0].region.shape).upper, ElementsAre(0.6, 0.3));
}

TEST(ReadCase, BlockMaterialIsTheMaterialWithItsOverrides) {
  const Model model = read_sample("plate").model;
  EXPECT_EQ(model.material.youngs_modulus, 210.0e9);
  EXPECT_EQ(model.material.density, 7850.0);
  ASSERT_EQ(model.block_materials.count("inclusion"), 1U);
  const Material& inclusion = model.block_materials.at("inclusion");
  EXPECT_EQ(inclusion.youngs_modulus, 210.0e9);
  EXPECT_EQ(inclusion.density, 2700.0);
  EXPECT_EQ(inclusion.where.line, 16);
}

TEST(ReadCase, BlockStrengthReplacesTheOtherKindOfStrength) {
  const Model model =
      read_sample("plate", {"material.fracture_energy=135", "materials.inclusion.critical_stretch=1e-3"})
          .model;
  EXPECT_EQ(model.material.fracture_energy, 135.0);
  EXPECT_EQ(model.block_materials.at("inclusion").critical_stretch, 1e-3);
  EXPECT_FALSE(model.block_materials.at("inclusion").fracture_energy.has_value());
}

TEST(ReadCase, BlockKernelKeepsWhatItDoesNotName) {
  const Model model = read_sample("plate", {"material.micromodulus={kernel: gaussian, p: 3}",
                                            "materials.inclusion.micromodulus={p: 4}"})
                          .model;
  EXPECT_EQ(model.material.micromodulus.p, 3.0);
  EXPECT_EQ(model.block_materials.at("inclusion").micromodulus.kernel, Kernel::gaussian);
  EXPECT_EQ(model.block_materials.at("inclusion").micromodulus.p, 4.0);
}

TEST(ReadCase, BoundaryConditionsKeepTheirOrderAndPlace) {
  const Model model = read_sample("plate").model;
  ASSERT_EQ(model.boundary.size(), 2U);
  const auto& fix = std::get<Fix>(model.boundary[0].what);
  EXPECT_THAT(fix.components, ElementsAre(0, 1));
  const auto& face = std::get<FaceRegion>(fix.at.shape);
  EXPECT_EQ(face.face.axis, 1);
  EXPECT_FALSE(face.face.upper);
  EXPECT_EQ(face.layers, 2);
  const auto& wall = std::get<Wall>(model.boundary[1].what);
  EXPECT_EQ(wall.face.axis, 1);
  EXPECT_TRUE(wall.face.upper);
  EXPECT_EQ(wall.type, WallType::mirror);
  EXPECT_EQ(model.boundary[1].where.line, 19);
}

TEST(ReadCase, PrescribedDisplacementsAcceptEveryTimeFunction) {
  for (const char* time : {"constant", "{ ramp: 1 }", "{ step: 0 }", "{ half_sine: 1 }", "{ ricker: 5 }",
                           "{ gaussian: [1, 2] }", "{ expression: \"sin(t)\" }"}) {
    const Model model =
        read_sample(
            "plate",
            {std::string("boundary.0={ prescribe: { y: 1.0e-4, x: 0 }, at: { face: y-, layers: 1 }, time: ") +
             time + " }"})
            .model;
    EXPECT_THAT(std::get<Prescribe>(model.boundary[0].what).components,
                ElementsAre(Pair(0, 0.0), Pair(1, 1.0e-4)));
  }
}

TEST(ReadCase, SurfaceNodesOfABarHaveTheirDisplacement) {
  const Model model = read_sample("bar").model;
  EXPECT_EQ(model.area, 1.0e-4);
  const auto& wall = std::get<Wall>(model.boundary[1].what);
  EXPECT_EQ(wall.type, WallType::surface_nodes);
  ASSERT_EQ(wall.displacement.size(), 1U);
  EXPECT_EQ(wall.displacement[0].text(), "0");
  EXPECT_FALSE(wall.traction.has_value());
}

TEST(ReadCase, CrackOfABarIsAPointWrittenInEitherWay) {
  for (const char* crack : {"[{ at: [0.5] }]", "[{ from: [0.5], to: [0.5] }]"}) {
    const Model model = read_sample("bar", {std::string("body.precracks=") + crack}).model;
    ASSERT_EQ(model.precracks.size(), 1U);
    EXPECT_THAT(model.precracks[0].points, ElementsAre(ElementsAre(0.5)));
  }
}

TEST(ReadCase, SelfCellGoesWithTheInverseDistanceKernelOfABar) {
  EXPECT_TRUE(read_sample("bar", {"material.micromodulus.kernel=inverse_distance", "material.self_cell=true"})
                  .model.self_cell);
  EXPECT_FALSE(read_sample("bar").model.self_cell);
}

TEST(ReadCase, CrackOfASolidIsAPolygon) {
  const Model model = read_sample("solid").model;
  EXPECT_EQ(model.dimension, 3);
  EXPECT_EQ(model.precracks.at(0).points.size(), 3U);
}

TEST(ReadCase, CloudFileIsRelativeToTheCaseAndMayNameTheBlocks) {
  const TemporaryFolder folder;
  const auto cloud = folder.write("cloud.csv", test::sample_cloud());
  const Model model = read_case(folder.write("case.yaml", test::sample_cases().at("cloud"))).model;
  EXPECT_EQ(std::get<CloudSpec>(model.particles).file, cloud);
  EXPECT_EQ(model.horizon.rule, HorizonSpec::Rule::neighbours);
  EXPECT_EQ(model.block_materials.at("core").density, 1000.0);
  EXPECT_EQ(std::get<FaceRegion>(std::get<Fix>(model.boundary[0].what).at.shape).depth, 0.1);
}

TEST(ReadCase, APeriodicCloudHasAPeriod) {
  const TemporaryFolder folder;
  (void)folder.write("cloud.csv", test::sample_cloud());
  const auto file = folder.write("case.yaml", test::sample_cases().at("cloud"));
  EXPECT_THAT(std::get<CloudSpec>(read_case(file).model.particles).period, ElementsAre());
  const Model model = read_case(file, {"body.particles.period=[0, 2.5]", "body.periodic=[y]"}).model;
  EXPECT_THAT(std::get<CloudSpec>(model.particles).period, ElementsAre(0.0, 2.5));
  EXPECT_THAT(model.periodic, ElementsAre(false, true, false));
}

TEST(ReadCase, TheoryOwnPoissonsRatioIsAccepted) {
  EXPECT_NO_THROW((void)read_sample("plate", {"material.poissons_ratio=0.3333333333333333"}));
  EXPECT_NO_THROW((void)read_sample("plate", {"body.plane=strain", "material.poissons_ratio=0.25"}));
  EXPECT_NO_THROW((void)read_sample("solid", {"material.poissons_ratio=0.25"}));
}

TEST(ReadCase, QuotedNumbersAreNumbers) {
  EXPECT_EQ(read_sample("plate", {"material.density='7850'"}).model.material.density, 7850.0);
  EXPECT_EQ(read_sample("plate", {"material.density=\"+7.85e3\""}).model.material.density, 7850.0);
}

TEST(ReadCase, DefaultsAreThoseOfTheReference) {
  const Case result = read_text(
      "body: { dimension: 2, particles: { grid: { lower: [0, 0], upper: [1, 1], spacing: 0.1 } },"
      " horizon: { ratio: 3 } }\nmaterial: { youngs_modulus: 1, density: 1 }\n");
  EXPECT_EQ(result.title, "");
  EXPECT_EQ(result.model.plane, Plane::stress);
  EXPECT_EQ(result.model.thickness, 1.0);
  EXPECT_EQ(result.model.material.micromodulus.kernel, Kernel::constant);
  EXPECT_EQ(result.model.calibration, Calibration::continuum);
  EXPECT_EQ(result.model.volume_correction, VolumeCorrection::none);
  EXPECT_FALSE(result.model.material.fracture_energy.has_value());
  EXPECT_TRUE(result.model.boundary.empty());
  EXPECT_FALSE(result.modal.has_value());
  EXPECT_EQ(result.output.directory, "out");
  EXPECT_THAT(result.output.fields, ElementsAre("displacement"));
}

TEST(ReadCase, ModalHasTwentyModesUnlessTheyOrARangeAreGiven) {
  EXPECT_EQ(read_sample("plate", {"analysis.modal="}).modal->modes, 20);
  EXPECT_EQ(read_sample("plate", {"analysis.modal={}"}).modal->modes, 20);
  EXPECT_EQ(read_sample("plate").modal->modes, 10);
  const ModalOptions shifted = *read_sample("plate", {"analysis.modal={shift: 500}"}).modal;
  EXPECT_EQ(shifted.modes, 20);
  EXPECT_EQ(shifted.shift, 500.0);
  const ModalOptions range = *read_sample("plate", {"analysis.modal={range: [0, 500]}"}).modal;
  EXPECT_FALSE(range.modes.has_value());
  EXPECT_EQ(range.range, std::pair(0.0, 500.0));
}

TEST(ReadCase, ModalWordsAreRead) {
  const ModalOptions options =
      *read_sample("plate", {"analysis.modal={solver: arpack, certificate: restart, reference: closed_form}"})
           .modal;
  EXPECT_EQ(options.solver, ModalSolver::arpack);
  EXPECT_EQ(options.certificate, CertificateMethod::restart);
  EXPECT_EQ(options.reference, ReferenceKind::closed_form);
}

TEST(ReadCase, OtherAnalysesMayStandInTheSameCase) {
  const Case result =
      read_sample("plate", {"analysis.static={loads: []}", "analysis.transient={dt: auto, end: 1}",
                            "analysis.quasistatic={control: event}", "analysis.dispersion={points: 30}"});
  EXPECT_TRUE(result.modal.has_value());
}

TEST(ReadCase, JsonIsRead) {
  const Case result = read_text(R"({
	"title": "plate",
	"body": {"dimension": 2, "particles": {"grid": {"lower": [0, 0], "upper": [1, 1], "spacing": 0.1}},
	         "horizon": {"ratio": 3}, "periodic": ["x", "y"]},
	"material": {"youngs_modulus": 2.1e11, "density": 7850},
	"analysis": {"modal": {"modes": 5}}
})");
  EXPECT_EQ(result.model.material.youngs_modulus, 2.1e11);
  EXPECT_THAT(result.model.periodic, ElementsAre(true, true, false));
  EXPECT_EQ(result.modal->modes, 5);
}

TEST(ReadCase, WindowsLineEndsAndByteOrderMarkAreAccepted) {
  std::string text = "\xEF\xBB\xBF";
  for (char c : test::sample_cases().at("plate")) text += c == '\n' ? "\r\n" : std::string(1, c);
  const Case result = read_text(text);
  EXPECT_EQ(result.title, "plate");
  EXPECT_EQ(std::get<GridSpec>(result.model.particles).where.line, 6);
}

TEST(ReadCase, AnchorsStandForTheirValue) {
  const Case result = read_text(
      "body: { dimension: 2, particles: { grid: { lower: &o [0, 0], upper: [1, 1], spacing: 0.1,"
      " remove: [ { ball: { centre: *o, radius: 0.2 } } ] } }, horizon: { ratio: 3 } }\n"
      "material: { youngs_modulus: 1, density: 1 }\n");
  const auto& grid = std::get<GridSpec>(result.model.particles);
  EXPECT_THAT(std::get<BallRegion>(grid.remove.at(0).shape).centre, ElementsAre(0, 0));
}

TEST(Override, ReplacesCreatesAndAppends) {
  const Case result =
      read_sample("plate", {"title=other", "body.horizon.ratio=4", "output.fields=[damage, strain]",
                            "boundary.2={ fix: [y], at: { nearest: [0.5, 0.5] } }",
                            "materials.inclusion.youngs_modulus=1e9"});
  EXPECT_EQ(result.title, "other");
  EXPECT_EQ(result.model.horizon.value, 4.0);
  EXPECT_THAT(result.output.fields, ElementsAre("damage", "strain"));
  ASSERT_EQ(result.model.boundary.size(), 3U);
  EXPECT_THAT(std::get<NearestRegion>(std::get<Fix>(result.model.boundary[2].what).at.shape).point,
              ElementsAre(0.5, 0.5));
  EXPECT_EQ(result.model.block_materials.at("inclusion").youngs_modulus, 1e9);
}

TEST(Override, LastOneWins) {
  EXPECT_EQ(read_sample("plate", {"body.horizon.ratio=4", "body.horizon.ratio=5"}).model.horizon.value, 5.0);
}

TEST(Override, StartsAListWhereThereIsNone) {
  EXPECT_EQ(read_sample("solid", {"boundary.0={ wall: z-, type: even }"}).model.boundary.size(), 1U);
}

TEST(CaseTemplate, OfATransientAnalysisIsAGoodCase) {
  const Case result = read_text(std::string(transient_template()));
  ASSERT_TRUE(result.transient.has_value());
  EXPECT_EQ(result.transient->loads.size(), 1U);
  EXPECT_EQ(result.transient->probes.size(), 3U);
  EXPECT_EQ(result.transient->sponge->faces.size(), 3U);
  EXPECT_TRUE(result.files.empty());
}

TEST(CaseTemplate, IsAGoodCase) {
  const Case result = read_text(std::string(modal_template()));
  EXPECT_EQ(result.model.dimension, 2);
  EXPECT_EQ(result.modal->modes, 10);
  EXPECT_EQ(result.model.precracks.size(), 1U);
}

}  // namespace
}  // namespace perimode
