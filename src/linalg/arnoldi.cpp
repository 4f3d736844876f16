// SPDX-License-Identifier: BSD-3-Clause
#include "arnoldi.hpp"

#include <arpack/arpack.h>

#include <algorithm>
#include <complex>
#include <numeric>
#include <string>
#include <vector>

#include "block_krylov.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

ArnoldiPairs arnoldi(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, Eigen::Index size,
                     int count, double tolerance, std::uint64_t seed, ArnoldiTarget target,
                     int most_restarts) {
  const char* which = target == ArnoldiTarget::magnitude ? "LM" : "LI";
  const auto n = static_cast<a_int>(size);
  const a_int columns = std::min<a_int>(n, std::max(2 * count + 2, 40));
  std::mt19937_64 random(seed);
  Eigen::MatrixXd residual = random_columns(n, 1, random);
  Eigen::MatrixXd basis(n, columns);
  std::vector<double> work(3 * static_cast<std::size_t>(n));
  std::vector<double> small(3 * static_cast<std::size_t>(columns) * (columns + 2));
  a_int parameter[11] = {1, 0, most_restarts, 1, 0, 0, 1, 0, 0, 0, 0};
  a_int pointer[14] = {};
  a_int ido = 0, info = 1;  // info = 1: start from our residual
  for (;;) {
    dnaupd_c(&ido, "I", n, which, count, tolerance, residual.data(), columns, basis.data(), n, parameter,
             pointer, work.data(), small.data(), static_cast<a_int>(small.size()), &info);
    if (ido != 1 && ido != -1) break;
    const Eigen::VectorXd y = apply(Eigen::Map<const Eigen::VectorXd>(&work[pointer[0] - 1], n));
    std::copy_n(y.data(), n, &work[pointer[1] - 1]);
  }
  if (info < 0)
    throw Error(ErrorKind::solver_failure, "ARPACK dnaupd failed with code " + std::to_string(info));
  if (parameter[4] < count) return {};
  std::vector<a_int> select(columns);
  Eigen::VectorXd real(count + 1), imaginary(count + 1), room(3 * columns);
  Eigen::MatrixXd part(n, count + 1);
  dneupd_c(1, "A", select.data(), real.data(), imaginary.data(), part.data(), n, 0.0, 0.0, room.data(), "I",
           n, which, count, tolerance, residual.data(), columns, basis.data(), n, parameter, pointer,
           work.data(), small.data(), static_cast<a_int>(small.size()), &info);
  if (info != 0)
    throw Error(ErrorKind::solver_failure, "ARPACK dneupd failed with code " + std::to_string(info));

  const Eigen::Index found = std::min<Eigen::Index>(parameter[4], count + 1);
  ArnoldiPairs raw{Eigen::VectorXcd(found), Eigen::MatrixXcd(n, found)};
  for (Eigen::Index j = 0; j < found; ++j) {
    raw.theta[j] = {real[j], imaginary[j]};
    const bool pair = imaginary[j] != 0.0 && j + 1 < std::min<Eigen::Index>(found + 1, count + 1);
    raw.vector.col(j).real() = part.col(j);
    raw.vector.col(j).imag().setZero();
    if (!pair) continue;
    raw.vector.col(j).imag() = part.col(j + 1);
    if (j + 1 >= found) continue;
    raw.theta[j + 1] = std::conj(raw.theta[j]);
    raw.vector.col(j + 1) = raw.vector.col(j).conjugate();
    ++j;
  }
  std::vector<Eigen::Index> rank(found);
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(raw.theta[a]) > std::abs(raw.theta[b]);
  });
  ArnoldiPairs out{raw.theta(rank), raw.vector(Eigen::all, rank)};
  out.vector.colwise().normalize();
  return out;
}

}  // namespace perimode
