// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/fracture/crack_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/stopwatch.hpp"
#include "modal/given_factor.hpp"
#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"
#include "perimode/assembly/precracks.hpp"
#include "perimode/bonds/crossing.hpp"
#include "perimode/fracture/griffith.hpp"

namespace perimode {

namespace {

constexpr double start_share = 0.002;  // of a factorisation: an updated column before any was measured

void check_growth(const Model& model, const ModalOptions& options, int n) {
  if (model.precracks.empty() || model.dimension == 1) {
    invalid_input({"pre-cracks that grow, in 2D or 3D",
                   model.precracks.empty() ? "no pre-crack" : "one of a bar", "add one to body.precracks",
                   model.where});
  }
  if (n < 1) invalid_input({"at least one step of crack growth", fmt::format("{}", n), "give 1 or more", {}});
  if (options.range || options.shift) {
    invalid_input({"the lowest modes of a growing crack",
                   options.range ? "a range" : "a shift",
                   "give analysis.modal.modes",
                   {}});
  }
  if (options.solver != EigenEngine::automatic && options.solver != EigenEngine::lanczos) {
    invalid_input({"the solver automatic or lanczos with a growing crack",
                   "another one",
                   "leave out analysis.modal.solver",
                   {}});
  }
}

template <int Dim>
void check_cracks(const Body<Dim>& intact, const Model& model) {
  const auto cracks = precracks<Dim>(model);
  const double spacing = typical_spacing(intact.particles, intact.section);
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    if (!crossing_ends<Dim>(intact.bonds, intact.particles, {cracks[c]}, spacing).empty()) continue;
    invalid_input({"a pre-crack that crosses bonds", "one that cuts none", "move it into the body",
                   model.precracks[c].where});
  }
}

template <int Dim>
double total_extent(const std::vector<Crack<Dim>>& cracks) {
  double sum = 0.0;
  for (const auto& crack : cracks) sum += extent(crack);
  return sum;
}

void take_modes(CrackGrowthStep& step, const ModalResult& modes, CrackGrowthResult& result) {
  step.frequency.assign(modes.frequency_hz.begin(), modes.frequency_hz.end());
  step.residual = modes.residual.size() > 0 ? modes.residual.maxCoeff() : 0.0;
  if (modes.status == EigenStatus::converged) return;
  result.converged = false;
  result.message = fmt::format("fraction {:.4g}: {}", step.fraction, modes.message);
}

/// The intact body whose bonds are cut step by step, and the factor that follows.
template <int Dim>
class GrowingCrack {
 public:
  GrowingCrack(Body<Dim> body, const Model& model, const ModalOptions& options, GrowthFactor way)
      : body_(std::move(body)),
        model_(model),
        options_(options),
        way_(way),
        stiffness_(body_),
        mass_(lumped_mass(body_)),
        shift_(lowest_modes_shift(body_, mass_)),
        matrix_(scalar_csr(assemble_stiffness(body_), body_.boundary.free_number, Zeros::keep)),
        factor_(CholeskyFactor::with_order(
            matrix_, dissection_order(matrix_, particle_of_free_dof(body_), particle_positions(body_)))) {}

  [[nodiscard]] CrackGrowthStep step(double fraction, CrackGrowthResult& result, const Sink& sink) {
    CrackGrowthStep step;
    step.fraction = fraction;
    const BondColumns columns = fraction > 0.0 ? cut(fraction, step) : BondColumns{};
    step.cut = cut_;
    const auto factoring = Clock::now();
    step.factor = follow(columns);
    step.seconds_factor = seconds_since(factoring);
    const auto searching = Clock::now();
    // The matrix itself is read for inertia alone.
    if (options_.certificate == CompletenessCheck::inertia) reassemble();
    take_modes(
        step,
        solve_modes_by(body_, options_, {stiffness_.product(), &matrix_, &factor_, shift_}, mass_, sink),
        result);
    step.seconds_modes = seconds_since(searching);
    return step;
  }

  [[nodiscard]] Offset factor_nonzeros() const { return factor_.fill().nonzeros; }

 private:
  BondColumns cut(double fraction, CrackGrowthStep& step) {
    const auto cracks = grown_precracks<Dim>(model_, fraction);
    step.crack_length = total_extent(cracks);
    std::vector<BondRef> bonds;
    for (const CrossingEnd& end :
         crossing_ends(body_.bonds, body_.particles, cracks, typical_spacing(body_.particles, body_.section)))
      bonds.push_back({end.particle, end.slot});
    bonds = with_images(body_, std::move(bonds));
    cut_ += static_cast<Offset>(bonds.size());
    BondColumns columns = bond_columns(body_, std::span<const BondRef>(bonds));
    stiffness_.break_bonds(bonds);
    return columns;
  }

  GrowthFactor follow(const BondColumns& columns) {
    if (factored_ && columns.count() == 0) return GrowthFactor::updated;
    if (factored_ && cheaper_updated(columns.count())) {
      const auto begin = Clock::now();
      if (factor_.update(columns.negative, columns.positive).status == FactorStatus::done) {
        column_seconds_ = seconds_since(begin) / columns.count();
        return GrowthFactor::updated;
      }
    }
    const auto begin = Clock::now();
    reassemble();
    if (factor_.factorize(matrix_, shift_, mass_) != FactorStatus::done)
      throw Error(ErrorKind::solver_failure,
                  "the stiffness of the cracked body is not positive semidefinite");
    factor_seconds_ = seconds_since(begin);
    factored_ = true;
    return GrowthFactor::fresh;
  }

  [[nodiscard]] bool cheaper_updated(Index columns) const {
    if (way_ != GrowthFactor::automatic) return way_ == GrowthFactor::updated;
    const double each = column_seconds_ > 0.0 ? column_seconds_ : start_share * factor_seconds_;
    return columns * each < factor_seconds_;
  }

  /// The values of K as it is, in the pattern of the intact body.
  void reassemble() {
    const Csr now = scalar_csr(assemble_stiffness(body_), body_.boundary.free_number, Zeros::keep);
    std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
    for (Index i = 0; i < now.rows; ++i) {
      Offset to = matrix_.row_start[i];
      for (Offset e = now.row_start[i]; e < now.row_start[i + 1]; ++e) {
        while (matrix_.column[to] != now.column[e]) ++to;
        matrix_.value[to] = now.value[e];
      }
    }
  }

  Body<Dim> body_;
  const Model& model_;
  const ModalOptions& options_;
  GrowthFactor way_;
  BreakableStiffness<Dim> stiffness_;
  Eigen::VectorXd mass_;
  double shift_;
  Csr matrix_;  ///< K as last assembled
  CholeskyFactor factor_;
  bool factored_ = false;
  Offset cut_ = 0;
  double factor_seconds_ = 0.0, column_seconds_ = 0.0;
};

/// One length of the cracks as a body of its own.
template <int Dim>
CrackGrowthStep separate_step(const Model& model, const ModalOptions& options, double fraction,
                              CrackGrowthResult& result, const Sink& sink) {
  Model now = model;
  now.precracks.clear();
  CrackGrowthStep step;
  step.fraction = fraction;
  if (fraction > 0.0) {
    const auto cracks = grown_precracks<Dim>(model, fraction);
    step.crack_length = total_extent(cracks);
    for (std::size_t c = 0; c < cracks.size(); ++c) {
      PrecrackSpec spec{{}, model.precracks[c].where};
      for (const auto& corner : cracks[c].corner) spec.points.emplace_back(corner.begin(), corner.end());
      now.precracks.push_back(std::move(spec));
    }
  }
  const auto begin = Clock::now();
  const Body<Dim> body = build_body<Dim>(now, sink);
  step.cut = body.cut;
  const ModalResult modes = solve_modes(body, options, sink);
  take_modes(step, modes, result);
  step.seconds_factor = modes.seconds_analyse + modes.seconds_factor;
  step.seconds_modes = seconds_since(begin) - step.seconds_factor;
  result.factor_nonzeros = modes.factor_nonzeros;
  return step;
}

}  // namespace

template <int Dim>
std::vector<Crack<Dim>> grown_precracks(const Model& model, double fraction) {
  auto cracks = precracks<Dim>(model);
  for (auto& crack : cracks) {
    auto& c = crack.corner;
    if (fraction == 1.0) continue;
    if constexpr (Dim == 2) c[1] = c[0] + fraction * (c[1] - c[0]);
    if constexpr (Dim == 3) {
      const Point<3> along = (c[1] - c[0]).normalized();
      for (std::size_t k = 2; k < c.size(); ++k) {
        const Point<3> foot = c[0] + along.dot(c[k] - c[0]) * along;
        c[k] = foot + fraction * (c[k] - foot);
      }
    }
  }
  return cracks;
}

template <int Dim>
CrackGrowthResult crack_growth_modes(const Model& model, const ModalOptions& options, int n,
                                     GrowthFactor factor, const Sink& sink) {
  check_growth(model, options, n);
  Model without = model;
  without.precracks.clear();
  Body<Dim> intact = build_body<Dim>(without, sink);
  check_request(intact.boundary.free, options);
  check_cracks(intact, model);
  const double asymmetry = perimode::asymmetry(stiffness_operator(intact));
  if (asymmetry > symmetric_to_round_off) {
    invalid_input({"a symmetric stiffness", fmt::format("an asymmetry of {:.2g}", asymmetry),
                   "use mirror or antimirror walls", model.where});
  }
  ModalOptions wanted = options;
  wanted.solver = EigenEngine::lanczos;
  if (!wanted.modes) wanted.modes = std::min<Index>(20, intact.boundary.free);
  if (wanted.certificate == CompletenessCheck::automatic) wanted.certificate = CompletenessCheck::restart;

  CrackGrowthResult result;
  result.converged = true;
  result.dofs = intact.boundary.free;
  const auto fraction = [n](int k) { return k == n ? 1.0 : static_cast<double>(k) / n; };
  if (model.calibration == Calibration::discrete_cut) {
    for (int k = 0; k <= n; ++k) {
      sink.report("crack growth", static_cast<double>(k) / (n + 1));
      result.steps.push_back(separate_step<Dim>(model, wanted, fraction(k), result, {}));
    }
    return result;
  }
  GrowingCrack<Dim> crack(std::move(intact), model, wanted, factor);
  for (int k = 0; k <= n; ++k) {
    sink.report("crack growth", static_cast<double>(k) / (n + 1));
    result.steps.push_back(crack.step(fraction(k), result, {}));
  }
  result.factor_nonzeros = crack.factor_nonzeros();
  return result;
}

#define PERIMODE_CRACK_GROWTH(D)                                                                         \
  template std::vector<Crack<D>> grown_precracks<D>(const Model&, double);                               \
  template CrackGrowthResult crack_growth_modes<D>(const Model&, const ModalOptions&, int, GrowthFactor, \
                                                   const Sink&)
PERIMODE_CRACK_GROWTH(1);
PERIMODE_CRACK_GROWTH(2);
PERIMODE_CRACK_GROWTH(3);
#undef PERIMODE_CRACK_GROWTH

}  // namespace perimode
