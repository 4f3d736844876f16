// SPDX-License-Identifier: BSD-3-Clause
// Bonds that break one after the other along a straight crack from the free edge, on bodies of n^d particles,
// horizon of three spacings, three layers on the left held, the last layer on the right loaded. Everything is
// counted in factorisations of the same run (factor_s, the least of a few):
//   event   10 bonds and the solution after them, the least and the median of many; CHOLMOD's own way beside
//           it (supernodal factor, turned into a simplicial L D L^T once, updown, solve)
//   batch   a bond's share of a downdate of 1, 10, 80, 900 bonds
//   stale   iterations of conjugate gradients to 1e-10 with the factor of the intact body
// Times are process CPU seconds; one thread unless PERIMODE_BENCH_THREADS says otherwise.
#include <benchmark/benchmark.h>
#include <cholmod.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <numeric>
#include <string>

#include "perimode/assembly/assemble.hpp"
#include "perimode/assembly/breakable_stiffness.hpp"
#include "perimode/linalg/conjugate_gradients.hpp"
#include "perimode/linalg/factor.hpp"
#include "perimode/linalg/threads.hpp"
#include "perimode/linalg/updated_solver.hpp"
#include "support/models.hpp"

namespace {

using perimode::Index;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

template <int Dim>
struct Cracked {
  perimode::Body<Dim> body;
  perimode::Csr k;
  std::vector<Index> order;
  std::vector<perimode::BondRef> crossing;  ///< the crack, from the free edge inwards
  Eigen::MatrixXd load;
  double factor_seconds = 1e300;
  std::unique_ptr<perimode::CholeskyFactor> factor;  ///< of the intact body

  explicit Cracked(int n) {
    perimode::Model m = perimode::test::box_model(std::vector<int>(Dim, n), 1.0 / n, 3.0);
    std::vector<int> all(Dim);
    std::iota(all.begin(), all.end(), 0);
    perimode::test::fix_face(m, 0, false, 3, all);
    body = perimode::build_body<Dim>(m);
    k = scalar_csr(assemble_stiffness(body), body.boundary.free_number, perimode::Zeros::keep);
    order = dissection_order(k, particle_of_free_dof(body), particle_positions(body));
    find_crossing();
    load = Eigen::MatrixXd::Zero(k.rows, 1);
    for (Index i = 0; i < body.count(); ++i)
      if (body.particles.position[i][0] > 1.0 - 1.0 / n)
        load(body.boundary.free_number[static_cast<std::size_t>(i) * Dim + 1], 0) =
            body.particles.position[i][1] > 0.5 ? 1.0 : -1.0;
    factor = std::make_unique<perimode::CholeskyFactor>(perimode::CholeskyFactor::with_order(k, order));
    for (int repeat = 0; repeat < 3; ++repeat) {
      const double begin = cpu_seconds();
      if (factor->factorize(k, 0.0, Eigen::VectorXd::Zero(k.rows)) != perimode::FactorStatus::done)
        std::abort();
      factor_seconds = std::min(factor_seconds, cpu_seconds() - begin);
    }
  }

  /// Bonds across the plane y = 1/2, by the place of their middle.
  void find_crossing() {
    struct Crossing {
      double x;
      perimode::BondRef bond;
    };
    std::vector<Crossing> found;
    for (Index i = 0; i < body.count(); ++i)
      for_each_bond(body.bonds, i, perimode::Which::alive, [&](const perimode::BondEnd<Dim>& end) {
        const perimode::Point<Dim> here = body.particles.position[i];
        const bool across = (here[1] < 0.5) != (here[1] + end.xi[1] < 0.5);
        if (across && end.neighbour > i) found.push_back({here[0] + 0.5 * end.xi[0], {i, end.slot}});
      });
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.x > b.x; });
    for (const Crossing& c : found) crossing.push_back(c.bond);
  }

  [[nodiscard]] std::vector<perimode::BondRef> bonds(std::size_t first, std::size_t count) const {
    const std::size_t begin = std::min(first, crossing.size());
    const std::size_t end = std::min(first + count, crossing.size());
    return with_images(body, {crossing.begin() + static_cast<std::ptrdiff_t>(begin),
                              crossing.begin() + static_cast<std::ptrdiff_t>(end)});
  }
  [[nodiscard]] perimode::SparseColumns columns(std::size_t first, std::size_t count) const {
    return bond_columns(body, bonds(first, count)).positive;
  }
  [[nodiscard]] perimode::SparseColumns none() const {
    perimode::SparseColumns out;
    out.rows = k.rows;
    return out;
  }
};

template <int Dim>
Cracked<Dim>& cracked(int n) {
  static std::unique_ptr<Cracked<Dim>> kept;
  static int kept_n = 0;
  if (kept_n != n) {
    kept.reset();
    kept = std::make_unique<Cracked<Dim>>(n);
    kept_n = n;
  }
  return *kept;
}

/// CHOLMOD's updown on the same matrix in the same order of elimination.
class Peer {
 public:
  Peer(const perimode::Csr& k, const std::vector<Index>& order) {
    cholmod_start(&common_);
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    std::vector<int> start(k.row_start.begin(), k.row_start.end()), given(order.begin(), order.end());
    cholmod_sparse a = {};
    a.nrow = a.ncol = k.rows;
    a.nzmax = k.column.size();
    a.p = start.data();
    a.i = const_cast<int*>(k.column.data());
    a.x = const_cast<double*>(k.value.data());
    a.stype = 1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    factor_ = cholmod_analyze_p(&a, given.data(), nullptr, 0, &common_);
    cholmod_factorize(&a, factor_, &common_);
    cholmod_change_factor(CHOLMOD_REAL, 0, 0, 1, 1, factor_, &common_);
  }
  ~Peer() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void downdate(const perimode::SparseColumns& columns) {
    cholmod_triplet* terms = cholmod_allocate_triplet(columns.rows, columns.count(), columns.row.size(), 0,
                                                      CHOLMOD_REAL, &common_);
    for (Index c = 0; c < columns.count(); ++c)
      for (perimode::Offset e = columns.start[c]; e < columns.start[c + 1]; ++e) {
        static_cast<int*>(terms->i)[terms->nnz] = columns.row[e];
        static_cast<int*>(terms->j)[terms->nnz] = c;
        static_cast<double*>(terms->x)[terms->nnz++] = columns.value[e];
      }
    cholmod_sparse* c = cholmod_triplet_to_sparse(terms, 0, &common_);
    cholmod_sparse* permuted =
        cholmod_submatrix(c, static_cast<int*>(factor_->Perm), columns.rows, nullptr, -1, 1, 1, &common_);
    cholmod_updown(0, permuted, factor_, &common_);
    cholmod_free_sparse(&permuted, &common_);
    cholmod_free_sparse(&c, &common_);
    cholmod_free_triplet(&terms, &common_);
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& b) {
    cholmod_dense right = {};
    right.nrow = right.d = right.nzmax = b.rows();
    right.ncol = 1;
    right.x = const_cast<double*>(b.data());
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, &right, &common_);
    Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(x->x), b.rows());
    cholmod_free_dense(&x, &common_);
    return out;
  }

 private:
  cholmod_common common_ = {};
  cholmod_factor* factor_ = nullptr;
};

constexpr std::size_t event_bonds = 10;

template <int Dim>
void event(benchmark::State& state) {
  Cracked<Dim>& c = cracked<Dim>(static_cast<int>(state.range(0)));
  const std::size_t events = std::min<std::size_t>(20, c.crossing.size() / (2 * event_bonds));
  perimode::UpdatedSolverOptions options;
  options.only = perimode::SolveWay::update;
  std::vector<double> ours, update, solve, theirs;
  double residual = 0.0, difference = 0.0, fresh = 0.0;
  for (auto _ : state) {
    perimode::Body<Dim> body = c.body;
    perimode::BreakableStiffness<Dim> stiffness(body);
    perimode::UpdatedSolver solver(stiffness.product(), c.k, c.order, options);
    Peer peer(c.k, c.order);
    Eigen::MatrixXd x;
    static_cast<void>(solver.solve(c.load, x));
    fresh = solver.fresh_residual();
    for (std::size_t e = 0; e < events; ++e) {
      const auto bonds = c.bonds(e * event_bonds, event_bonds);
      const perimode::SparseColumns lost = bond_columns(body, bonds).positive;
      stiffness.break_bonds(bonds);
      double begin = cpu_seconds();
      solver.change(c.none(), lost);
      const perimode::SolveOutcome outcome = solver.solve(c.load, x);
      ours.push_back((cpu_seconds() - begin) / c.factor_seconds);
      residual = std::max(residual, outcome.residual);
      begin = cpu_seconds();
      peer.downdate(lost);
      const Eigen::VectorXd y = peer.solve(c.load);
      theirs.push_back((cpu_seconds() - begin) / c.factor_seconds);
      difference = std::max(difference, (x.col(0) - y).norm() / y.norm());
    }
  }
  state.counters["factor_s"] = c.factor_seconds;
  state.counters["event_min"] = *std::min_element(ours.begin(), ours.end());
  state.counters["event_median"] = median(ours);
  state.counters["peer_min"] = *std::min_element(theirs.begin(), theirs.end());
  state.counters["peer_median"] = median(theirs);
  state.counters["residual"] = residual;
  state.counters["fresh_residual"] = fresh;
  state.counters["difference"] = difference;
}

template <int Dim>
void batch(benchmark::State& state) {
  Cracked<Dim>& c = cracked<Dim>(static_cast<int>(state.range(0)));
  const auto size = static_cast<std::size_t>(state.range(1));
  const std::size_t batches = std::clamp<std::size_t>(c.crossing.size() / (2 * size), 1, 10);
  double least = 1e300, nanoseconds = 0.0;
  for (auto _ : state) {
    for (std::size_t b = 0; b < batches; ++b) {
      const perimode::SparseColumns lost = c.columns(b * size, size);
      const double begin = cpu_seconds();
      const perimode::UpdateResult result = c.factor->update(c.none(), lost);
      const double seconds = cpu_seconds() - begin;
      if (result.status != perimode::FactorStatus::done) return state.SkipWithError("singular");
      if (seconds / lost.count() < least) {
        least = seconds / lost.count();
        nanoseconds = 1e9 * seconds / static_cast<double>(result.touched);
      }
      if (c.factor->update(lost, c.none()).status != perimode::FactorStatus::done) std::abort();
    }
  }
  state.counters["factor_s"] = c.factor_seconds;
  state.counters["bond"] = least / c.factor_seconds;
  state.counters["ns_per_number"] = nanoseconds;
}

template <int Dim>
void stale(benchmark::State& state) {
  Cracked<Dim>& c = cracked<Dim>(static_cast<int>(state.range(0)));
  const auto preconditioner = perimode::factor_preconditioner(*c.factor, c.k.rows);
  const Eigen::VectorXd start = c.factor->solve(c.load);
  perimode::CgResult result;
  double seconds = 0.0;
  for (auto _ : state) {
    perimode::Body<Dim> body = c.body;
    perimode::BreakableStiffness<Dim> stiffness(body);
    stiffness.break_bonds(c.bonds(0, static_cast<std::size_t>(state.range(1))));
    const double begin = cpu_seconds();
    result = conjugate_gradients(stiffness.product(), c.load, preconditioner, {.tolerance = 1e-10}, &start);
    seconds = cpu_seconds() - begin;
  }
  state.counters["iterations"] = result.iterations;
  state.counters["factorisations"] = seconds / c.factor_seconds;
  if (!result.converged) state.SkipWithError(result.message.c_str());
}

template <int Dim>
void register_all(const char* dimension, int n) {
  const auto add = [&](const char* what, void (*run)(benchmark::State&), std::vector<std::int64_t> more) {
    auto* b = benchmark::RegisterBenchmark((std::string(what) + "/" + dimension).c_str(), run);
    more.insert(more.begin(), n);
    b->Args(more)->Iterations(1)->Unit(benchmark::kSecond);
  };
  add("event", event<Dim>, {});
  for (const int size : {1, 10, 80, 900}) add("batch", batch<Dim>, {size});
  for (const int broken : {1, 10, 100, 400, 1000}) add("stale", stale<Dim>, {broken});
}

}  // namespace

int main(int argc, char** argv) {
  const char* threads = std::getenv("PERIMODE_BENCH_THREADS");
  perimode::set_threads(threads != nullptr ? std::stoi(threads) : 1);
  register_all<2>("2D", 40);
  register_all<2>("2D", 100);
  register_all<2>("2D", 200);
  register_all<2>("2D", 400);
  register_all<3>("3D", 20);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
