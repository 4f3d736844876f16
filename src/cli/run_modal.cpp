// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "interrupt.hpp"
#include "machine.hpp"
#include "modal_output.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/core/version.hpp"
#include "perimode/io/case.hpp"
#include "perimode/io/matrix_market.hpp"
#include "perimode/io/result_directory.hpp"
#include "perimode/modal/plan.hpp"
#include "summary.hpp"

namespace perimode::cli {

namespace {

/// Closed-form modes enough to stand beside every computed one.
References references_of(const Case& input, const ModalOptions& options, const ModalResult& result,
                         Console& console) {
  References none(static_cast<std::size_t>(result.count()));
  if (options.reference == ReferenceKind::none || result.count() == 0) return none;
  const bool from_lowest = !options.range && !options.shift;
  const double top = result.angular_frequency.maxCoeff() * (1.0 + 1e-6);
  std::string why_not;
  for (int count = static_cast<int>(result.count());; count *= 2) {
    const auto exact = closed_form_modes(input.model, count, why_not);
    if (!exact) {
      console.warning("no closed form: " + why_not);
      return none;
    }
    const bool all = static_cast<int>(exact->size()) < count;
    if (from_lowest || all || exact->back().discrete > top)
      return match_references(result, *exact, from_lowest);
  }
}

const char* status_text(EigenStatus status) {
  switch (status) {
    case EigenStatus::converged:
      return "done";
    case EigenStatus::not_converged:
      return "not_converged";
    case EigenStatus::not_certified:
      break;
  }
  return "not_certified";
}

template <int Dim>
std::vector<double> total_mass(const Body<Dim>& body) {
  double mass = 0.0;
  for (Index i = 0; i < body.count(); ++i)
    mass += body.density[body.particles.block[i]] * body.particles.volume[i];
  return std::vector<double>(Dim, mass);
}

template <int Dim>
void write_matrices(const std::filesystem::path& folder, const Body<Dim>& body, double asymmetry) {
  const Csr k = scalar_csr(assemble_stiffness(body), body.boundary.free_number);
  write_matrix_market(folder / "K.mtx", k,
                      asymmetry == 0.0 ? MatrixSymmetry::symmetric : MatrixSymmetry::general);
  const Eigen::VectorXd m = lumped_mass(body);
  write_matrix_market(folder / "M.mtx", {m.data(), static_cast<std::size_t>(m.size())});
}

/// The modes, unless they would not fit in memory; errors point at the section that asks for them.
template <int Dim>
ModalResult solve_checked(const Body<Dim>& body, const Case& input, const Sink& sink) {
  try {
    check_request(body.boundary.free, *input.modal);
    ModalOptions options = *input.modal;
    options.memory_limit = 0.9 * available_memory();
    // The exact prediction may cost an assembly and an ordering; it is made where memory could run short.
    if (3.0 * rough_memory(body, options) > available_memory()) {
      sink.report("predicting memory");
      refuse_if_too_large(plan_modes(body, options).memory_bytes, "these modes");
    }
    return solve_modes(body, options, sink);
  } catch (const Error& error) {
    throw error.kind() == ErrorKind::invalid_input ? at(error, input.modal_where) : error;
  }
}

template <int Dim>
int run_modal_in(const Case& input, const Arguments& arguments, Console& console) {
  const auto start = Clock::now();
  const ModalOptions options = *input.modal;
  refuse_if_too_large(least_body_bytes(input.model), "the body");
  ResultDirectory folder(arguments.output.value_or(input.output.directory), arguments.force);
  set_unfinished_result(folder.unfinished());

  const Sink sink = console.sink();
  const Body<Dim> body = build_body<Dim>(input.model, sink);
  const double seconds_body = seconds_since(start);
  const ModalResult result = solve_checked(body, input, sink);
  const References references = references_of(input, options, result, console);

  console.stage("writing", -1.0);
  const auto writing = Clock::now();
  const Table table = modes_table(result, references, Dim);
  write_csv(folder.temporary() / "modes.csv", table);
  write_modes_exodus(folder.temporary() / "modes.exo", input.title, body, result);
  if (arguments.matrices) write_matrices(folder.temporary(), body, result.asymmetry);

  nlohmann::ordered_json summary = begin_summary("modal", input.title, body);
  summary["nonzeros"] = result.nonzeros;
  summary["factor_nonzeros"] = result.factor_nonzeros;
  summary["solver"] = result.solver;
  summary["reason"] = result.choice.reason;
  summary["status"] = status_text(result.status);
  summary["message"] = result.message;
  summary["symmetric"] = result.left.cols() == 0;
  summary["asymmetry"] = result.asymmetry;
  if (result.left.cols() > 0) summary["imaginary"] = result.imaginary;
  summary["rigid_modes"] = result.rigid_modes;
  summary["mechanisms"] = result.mechanisms;
  summary["solves"] = result.solves;
  summary["products"] = result.products;
  summary["certificate"] = certificate_json(result);
  add_run(summary, {{"body", seconds_body},
                    {"assemble", result.seconds_assemble},
                    {"analyse", result.seconds_analyse},
                    {"factor", result.seconds_factor},
                    {"iterate", result.seconds_iterate},
                    {"certificate", result.certificate.seconds},
                    {"write", seconds_since(writing)},
                    {"total", seconds_since(start)}});
  summary["modes"] = table_json(table);
  commit_summary(folder, summary);
  console.clear_progress();

  fmt::print("{}", modes_text(result, references, total_mass(body)));
  const Certificate& c = result.certificate;
  fmt::print("{} particles, {} bonds, {} dofs; {}; {}\n", body.count(), count_bonds(body.bonds, body.count()),
             body.boundary.free, result.solver,
             c.complete ? fmt::format("complete by {} ({} counted, {} solves, {:.2f} s)", c.method, c.count,
                                      c.solves, c.seconds)
                        : std::string(c.asked ? "not certified complete" : "completeness not checked"));
  fmt::print("results in {}\n", folder.target().string());
  std::fflush(stdout);
  if (result.status == EigenStatus::converged) return 0;
  console.error(result.message.empty() ? status_text(result.status) : result.message);
  return 1;
}

}  // namespace

int run_modal(const Arguments& arguments, Console& console) {
  const Case input = read_case(arguments.case_file, arguments.set);
  if (!input.modal) {
    invalid_input({"a section analysis.modal",
                   "none",
                   "add `analysis: { modal: { modes: 20 } }`",
                   {arguments.case_file.string(), 0, 0}});
  }
  if (arguments.crack_growth) return run_crack_growth(input, arguments, console);
  return with_dimension(input.model.dimension, [&](auto dimension) {
    return run_modal_in<dimension.value>(input, arguments, console);
  });
}

}  // namespace perimode::cli
