// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "io/case_sections.hpp"

namespace perimode::case_file {

namespace {

constexpr int default_modes = 20;

std::pair<double, double> read_range(const Cursor& cursor) {
  const std::vector<Cursor> ends = cursor.items("[0, 5000]");
  if (ends.size() != 2) cursor.complain("a list of 2 frequencies in Hz", "for example [0, 5000]");
  const std::pair<double, double> range{ends[0].number({"Hz", "0", Sign::non_negative}),
                                        ends[1].number({"Hz", "5000"})};
  if (!(range.first < range.second)) {
    ends[1].complain(fmt::format("a frequency > {} Hz", range.first), "give the lower end first");
  }
  return range;
}

ModalOptions read_modal(const Cursor& cursor) {
  ModalOptions options;
  if (cursor.node().kind == CaseNode::Kind::null) {  // `modal:` with nothing: all defaults
    options.modes = default_modes;
    return options;
  }
  const Section modal(cursor, {"modes", "range", "shift", "solver", "certificate", "reference"});
  if (modal.has("range"))
    (void)modal.at_most_one({"modes", "range"}), (void)modal.at_most_one({"shift", "range"});
  if (const auto modes = modal.find("modes")) options.modes = modes->integer(1, "20");
  if (const auto range = modal.find("range")) options.range = read_range(*range);
  if (const auto shift = modal.find("shift"))
    options.shift = shift->number({"Hz", "1000", Sign::non_negative});
  if (!options.modes && !options.range) options.modes = default_modes;
  if (const auto solver = modal.find("solver")) {
    options.solver = solver->choice<ModalSolver>({{"auto", ModalSolver::automatic},
                                                  {"lanczos", ModalSolver::lanczos},
                                                  {"arpack", ModalSolver::arpack},
                                                  {"dense", ModalSolver::dense},
                                                  {"chebyshev", ModalSolver::chebyshev},
                                                  {"inverse", ModalSolver::inverse},
                                                  {"slepc", ModalSolver::slepc}});
  }
  if (const auto certificate = modal.find("certificate")) {
    options.certificate = certificate->choice<CertificateMethod>({{"auto", CertificateMethod::automatic},
                                                                  {"inertia", CertificateMethod::inertia},
                                                                  {"restart", CertificateMethod::restart},
                                                                  {"none", CertificateMethod::none}});
  }
  if (const auto reference = modal.find("reference")) {
    options.reference = reference->choice<ReferenceKind>(
        {{"none", ReferenceKind::none}, {"closed_form", ReferenceKind::closed_form}});
  }
  return options;
}

}  // namespace

void read_analysis(const Cursor& cursor, InputFiles& files, Case& result) {
  const Section analysis(cursor, {"modal", "static", "transient", "quasistatic", "dispersion"});
  if (const auto modal = analysis.find("modal")) {
    result.modal = read_modal(*modal);
    result.modal_where = modal->where();
  }
  if (const auto statics = analysis.find("static")) {
    result.statics = read_static(*statics, facts_of(result.model), files);
    result.static_where = statics->where();
  }
  if (const auto transient = analysis.find("transient")) read_transient(*transient, files, result);
  if (const auto quasistatic = analysis.find("quasistatic")) read_quasistatic(*quasistatic, files, result);
  if (const auto dispersion = analysis.find("dispersion")) read_dispersion(*dispersion, files, result);
}

OutputSpec read_output(const Cursor& cursor) {
  const Section section(cursor, {"directory", "fields"});
  OutputSpec output;
  output.where = cursor.where();
  if (const auto directory = section.find("directory")) output.directory = directory->text("out/plate");
  if (const auto fields = section.find("fields")) {
    output.fields.clear();
    for (const Cursor& item : fields->items("[displacement]")) {
      output.fields.push_back(item.choice<std::string>({{"displacement", "displacement"},
                                                        {"velocity", "velocity"},
                                                        {"damage", "damage"},
                                                        {"strain", "strain"},
                                                        {"stress", "stress"},
                                                        {"energy", "energy"}}));
    }
  }
  return output;
}

}  // namespace perimode::case_file
