// SPDX-License-Identifier: BSD-3-Clause
#include "slepc.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "block_krylov.hpp"
#include "dense.hpp"
#include "perimode/core/error.hpp"
#include "slepc_module.hpp"
#include "sparse_engine.hpp"

namespace perimode {
namespace {

/// Loads the module with its own libraries ahead of those of the process: both MUMPS, with MPI and without,
/// then find what they were linked with. It stays loaded.
const slepc_module::Functions& loaded_module() {
  static const slepc_module::Functions* const functions = [] {
    std::string why;
    for (const char* file : {PERIMODE_SLEPC_BUILT, PERIMODE_SLEPC_INSTALLED}) {
      void* handle = dlopen(file, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
      void* entry = handle != nullptr ? dlsym(handle, slepc_module::entry_point) : nullptr;
      if (entry != nullptr) return reinterpret_cast<slepc_module::EntryPoint>(entry)();
      why += std::string("; ") + dlerror();
    }
    throw Error(ErrorKind::environment, "the module with SLEPc cannot be loaded" + why);
  }();
  return *functions;
}

void require(const char* failure) {
  if (failure != nullptr) throw Error(ErrorKind::solver_failure, std::string("SLEPc: ") + failure);
}

struct Pairs {
  std::vector<double> value;
  std::vector<double> vector;  ///< one after the other
};

/// A = M^-1/2 K M^-1/2 and what is asked of it.
class SlepcProblem {
 public:
  SlepcProblem(const EigenProblem& problem, const EigenOptions& options)
      : module_(loaded_module()),
        tolerance_(std::min(options.tolerance, 1e-12)),
        rows_(problem.stiffness->rows),
        value_(problem.stiffness->value) {
    const Csr& k = *problem.stiffness;
    const Eigen::VectorXd scale = problem.mass->cwiseSqrt().cwiseInverse();
    for (Index i = 0; i < k.rows; ++i)
      for (Offset e = k.row_start[i]; e < k.row_start[i + 1]; ++e) value_[e] *= scale[i] * scale[k.column[e]];
    matrix_ = {k.rows, k.row_start.data(), k.column.data(), value_.data()};
  }

  [[nodiscard]] Pairs nearest(const Eigen::MatrixXd& deflated, Eigen::Index count, double target) const {
    const slepc_module::Vectors known = {static_cast<std::int32_t>(deflated.cols()), deflated.data()};
    Pairs out;
    Taker taker{out, rows_};
    require(module_.nearest(&matrix_, &known, static_cast<std::int32_t>(count), target, tolerance_, take,
                            &taker));
    return out;
  }
  [[nodiscard]] Pairs between(double lower, double upper) const {
    Pairs out;
    Taker taker{out, rows_};
    require(module_.between(&matrix_, lower, upper, tolerance_, take, &taker));
    return out;
  }
  /// K >= 0 leaves no eigenvalue below zero.
  [[nodiscard]] Offset below(double sigma) const {
    std::int64_t count = 0;
    if (sigma > 0.0) require(module_.below(&matrix_, sigma, &count));
    return count;
  }

 private:
  struct Taker {
    Pairs& pairs;
    Index rows;
  };
  static void take(void* context, double value, const double* vector) {
    auto& [pairs, rows] = *static_cast<Taker*>(context);
    pairs.value.push_back(value);
    pairs.vector.insert(pairs.vector.end(), vector, vector + rows);
  }

  const slepc_module::Functions& module_;
  double tolerance_;
  Index rows_;
  std::vector<double> value_;
  slepc_module::Matrix matrix_ = {};
};

Eigen::MatrixXd columns_of(const Pairs& pairs, Index rows) {
  return Eigen::Map<const Eigen::MatrixXd>(pairs.vector.data(), rows,
                                           static_cast<Eigen::Index>(pairs.value.size()));
}

/// Writes the certificate: `found` eigenvalues (known ones included) where inertia counts `counted`.
void conclude(EigenResult& out, Offset found, Offset counted, double at, double seconds) {
  out.certificate = {
      .complete = found == counted, .method = "inertia", .count = counted, .at = at, .seconds = seconds};
  out.status = out.certificate.complete ? EigenStatus::converged : EigenStatus::not_certified;
  if (!out.certificate.complete)
    out.message = "SLEPc found " + std::to_string(found) + " eigenvalues where inertia counts " +
                  std::to_string(counted);
}

/// All eigenvalues from `lower` > 0 to `upper`.
EigenResult solve_between(const EigenProblem& problem, const SlepcProblem& slepc, double lower,
                          double upper) {
  EigenResult out;
  const Stopwatch iteration;
  const Pairs pairs = slepc.between(lower, upper);
  rayleigh_ritz(problem, columns_of(pairs, problem.stiffness->rows), out);
  out.seconds_iterate = iteration.seconds();
  const Stopwatch counting;
  const Offset counted = slepc.below(upper) - slepc.below(lower);
  conclude(out, static_cast<Offset>(pairs.value.size()), counted, upper, counting.seconds());
  return out;
}

/// The found eigenvalues by their distance from the target, and how many of the first ones end at a gap.
struct Ranked {
  std::vector<Eigen::Index> rank;
  Eigen::Index end = 0;  ///< 0: no gap after `count` of them
  double radius = 0.0;   ///< inside the gap
};

Ranked ranked(const std::vector<double>& value, double target, Eigen::Index count) {
  Ranked out;
  const auto found = static_cast<Eigen::Index>(value.size());
  const auto distance = [&](Eigen::Index i) { return std::abs(value[i] - target); };
  out.rank.resize(value.size());
  std::iota(out.rank.begin(), out.rank.end(), 0);
  std::stable_sort(out.rank.begin(), out.rank.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return distance(a) < distance(b); });
  constexpr double gap = 1e-6;
  for (Eigen::Index k = count; k < found && out.end == 0; ++k) {
    const double inner = distance(out.rank[k - 1]), outer = distance(out.rank[k]);
    if (outer - inner <= gap * outer) continue;
    out.end = k;
    out.radius = 0.5 * (inner + outer);
  }
  return out;
}

/// The `count` eigenvalues nearest to `target`. What the count says is missing is looked for again, beside
/// everything found.
EigenResult solve_around(const EigenProblem& problem, const EigenOptions& options, const SlepcProblem& slepc,
                         double target, Eigen::Index count, const Sink& sink) {
  EigenResult out;
  const Index rows = problem.stiffness->rows;
  const Eigen::MatrixXd known = known_directions(problem);
  Pairs found;
  constexpr int most_searches = 6;
  Eigen::Index spare = 4;
  for (int search = 0; search < most_searches; ++search) {
    sink.report("iteration");
    const Stopwatch iteration;
    const auto have = static_cast<Eigen::Index>(found.value.size());
    const Eigen::Index more = std::max(count + spare - have, spare);
    if (known.cols() + have + more >= rows) return solve_dense(problem, options);
    const Pairs fresh = slepc.nearest(beside(known, columns_of(found, rows)), more, target);
    found.value.insert(found.value.end(), fresh.value.begin(), fresh.value.end());
    found.vector.insert(found.vector.end(), fresh.vector.begin(), fresh.vector.end());
    out.seconds_iterate += iteration.seconds();
    out.restarts = search;

    const Ranked sorted = ranked(found.value, target, count);
    spare *= 2;
    if (sorted.end == 0) continue;
    const Eigen::MatrixXd vector = columns_of(found, rows);
    rayleigh_ritz(problem, vector(Eigen::all, std::vector(sorted.rank.begin(), sorted.rank.begin() + count)),
                  out);
    out.status = EigenStatus::converged;
    out.certificate = {.asked = false, .method = "none"};
    if (options.check == CompletenessCheck::none) return out;
    sink.report("certificate");
    const Stopwatch counting;
    const double lower = target - sorted.radius, upper = target + sorted.radius;
    const Offset counted = slepc.below(upper) - slepc.below(lower);
    conclude(out, sorted.end + (lower <= 0.0 ? known.cols() : 0), counted, upper, counting.seconds());
    if (out.certificate.complete) return out;
  }
  if (out.status == EigenStatus::not_converged)
    out.message =
        "SLEPc found " + std::to_string(found.value.size()) + " of " + std::to_string(count) + " modes";
  return out;
}

}  // namespace

EigenResult solve_slepc(const EigenProblem& problem, const EigenOptions& options, const Sink& sink) {
  sink.report("analysis");
  const SlepcProblem slepc(problem, options);
  const double below_all = negative_shift(problem, options);
  EigenResult out;
  if (options.has_range) {
    // An end that is an eigenvalue to round-off belongs to the range.
    const double slack = 1e-9 * std::max(std::abs(options.lower), std::abs(options.upper));
    const double lower = options.lower - slack, upper = options.upper + slack;
    if (lower > 0.0) {
      out = solve_between(problem, slepc, lower, upper);
    } else {
      const Offset known = problem.known != nullptr ? problem.known->cols() : 0;
      const Offset count = slepc.below(upper) - known;
      if (count > 0) {
        out = solve_around(problem, options, slepc, below_all, count, sink);
      } else {
        rayleigh_ritz(problem, Eigen::MatrixXd(problem.stiffness->rows, 0), out);
        conclude(out, known, known + count, upper, 0.0);
      }
    }
  } else {
    const double target = options.has_shift && options.shift > 0.0 ? options.shift : below_all;
    const Eigen::Index known = problem.known != nullptr ? problem.known->cols() : 0;
    const auto count = std::min<Eigen::Index>(options.count, problem.stiffness->rows - known);
    out = solve_around(problem, options, slepc, target, count, sink);
    out.shift = target;
  }
  out.engine = "slepc";
  return out;
}

}  // namespace perimode
