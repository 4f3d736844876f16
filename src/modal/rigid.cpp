// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/modal/rigid.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "perimode/assembly/assemble.hpp"
#include "perimode/bonds/connectivity.hpp"

namespace perimode {

namespace {

template <int Dim>
constexpr int motions = Dim * (Dim + 1) / 2;

/// Component a of rigid motion k (translations first, then rotations) at x from the piece's centre.
template <int Dim>
double motion(int k, int a, const Point<Dim>& x) {
  if (k < Dim) return k == a ? 1.0 : 0.0;
  if constexpr (Dim == 2) return a == 0 ? -x[1] : x[0];
  if constexpr (Dim == 3) {  // e_r x x
    const int r = k - 3;
    if (a == (r + 1) % 3) return -x[(r + 2) % 3];
    if (a == (r + 2) % 3) return x[(r + 1) % 3];
  }
  return 0.0;
}

/// Stiffness of all bonds of the particle of every free dof, N/m.
template <int Dim>
std::vector<double> own_stiffness(const Body<Dim>& body) {
  std::vector<double> own(static_cast<std::size_t>(body.boundary.free), 1.0);
  for (Index i = 0; i < body.count(); ++i) {
    double sum = 0.0;
    for_each_bond(body.bonds, i, Which::alive,
                  [&](const BondEnd<Dim>& end) { sum += std::abs(bond_stiffness(body, i, end)); });
    for (int a = 0; a < Dim; ++a) {
      const Index d = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (d >= 0 && sum > 0.0) own[static_cast<std::size_t>(d)] = sum;
    }
  }
  return own;
}

}  // namespace

template <int Dim>
Eigen::MatrixXd rigid_modes(const Body<Dim>& body, const LinearOperator& stiffness,
                            const Eigen::VectorXd& mass) {
  constexpr int R = motions<Dim>;
  using Small = Eigen::Matrix<double, R, R>;
  const Index n = body.count();
  const Pieces pieces = find_pieces(body.bonds, n);

  std::vector<Point<Dim>> centre(pieces.count, Point<Dim>::Zero());
  std::vector<double> members(pieces.count, 0.0);
  for (Index i = 0; i < n; ++i) {
    centre[pieces.of[i]] += body.particles.position[i];
    members[pieces.of[i]] += 1.0;
  }
  for (Index p = 0; p < pieces.count; ++p) centre[p] /= members[p];

  // All pieces at once: column k holds motion k of every piece, as K couples no two pieces.
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(mass.size(), R);
  std::vector<Index> piece_of_dof(mass.size());
  for (Index i = 0; i < n; ++i) {
    for (int a = 0; a < Dim; ++a) {
      const Index d = body.boundary.free_number[static_cast<std::size_t>(i) * Dim + a];
      if (d < 0) continue;
      piece_of_dof[d] = pieces.of[i];
      const Point<Dim> x = body.particles.position[i] - centre[pieces.of[i]];
      for (int k = 0; k < R; ++k) q(d, k) = motion<Dim>(k, a, x);
    }
  }
  const Eigen::MatrixXd kq = multiply(stiffness, q);

  // Per piece: the metric of mass, that of displacements, and that of forces, every row of K against the
  // stiffness of the particle's own bonds: a soft support is seen however stiff the rest of the body is.
  std::vector<Small> gram(pieces.count, Small::Zero());
  std::vector<Small> place(pieces.count, Small::Zero());
  std::vector<Small> force(pieces.count, Small::Zero());
  const std::vector<double> own = own_stiffness(body);
  for (Index d = 0; d < mass.size(); ++d) {
    gram[piece_of_dof[d]] += mass[d] * q.row(d).transpose() * q.row(d);
    place[piece_of_dof[d]] += q.row(d).transpose() * q.row(d);
    force[piece_of_dof[d]] += kq.row(d).transpose() * kq.row(d) / (own[d] * own[d]);
  }
  struct Found {
    Index piece;
    Eigen::Matrix<double, R, 1> combination;
  };
  std::vector<Found> found;
  for (Index p = 0; p < pieces.count; ++p) {
    // Motions scaled to unit size first, so that a rotation is not lost beside a translation.
    Small unit = Small::Zero();
    for (int k = 0; k < R; ++k) {
      const double size = std::sqrt(place[p](k, k));
      if (size > 0.0) unit(k, k) = 1.0 / size;
    }
    const Eigen::SelfAdjointEigenSolver<Small> metric(unit * place[p] * unit);
    Eigen::Matrix<double, R, Eigen::Dynamic> basis(R, 0);
    for (int k = 0; k < R; ++k) {
      if (metric.eigenvalues()[k] <= 1e-10)
        continue;  // not an own motion of this piece (a lone particle's rotation)
      basis.conservativeResize(R, basis.cols() + 1);
      basis.col(basis.cols() - 1) = unit * metric.eigenvectors().col(k) / std::sqrt(metric.eigenvalues()[k]);
    }
    if (basis.cols() == 0) continue;  // nothing of this piece is free
    const Eigen::MatrixXd energy = basis.transpose() * force[p] * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> null(energy);
    // |D^-1 K q| / |q|, D the stiffness of every particle's own bonds: about (share of rows at the
    // support)^1/2 times a bond's share of a particle for motions that are held, 1e-15 by round-off for free
    // ones (more for bodies far from the origin); ascending, so the free ones come first.
    // Products of forces carry round-off of the largest of them.
    constexpr double round_off = 1e-9, of_products = 1e-13;
    const double zero = std::max(round_off * round_off, of_products * null.eigenvalues().maxCoeff());
    const Eigen::Index free = (null.eigenvalues().array() <= zero).count();
    if (free == 0) continue;
    Eigen::MatrixXd combination = basis * null.eigenvectors().leftCols(free);
    const Eigen::LLT<Eigen::MatrixXd> root(combination.transpose() * gram[p] * combination);
    combination = root.matrixU().solve<Eigen::OnTheRight>(combination).eval();  // M-orthonormal
    // Any basis will do; the one that starts with pure translations reads best.
    const Eigen::MatrixXd part = combination.transpose() * gram[p] * unit;
    std::vector<Eigen::Index> moving;
    for (Eigen::Index k = 0; k < R; ++k) {
      if (part.col(k).norm() > 1e-6) moving.push_back(k);
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> ordered(part(Eigen::all, moving));
    combination *= Eigen::MatrixXd(ordered.householderQ());
    for (Eigen::Index k = 0; k < free; ++k) found.push_back({p, combination.col(k)});
  }
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(mass.size(), static_cast<Eigen::Index>(found.size()));
  for (Index d = 0; d < mass.size(); ++d) {
    for (std::size_t m = 0; m < found.size(); ++m) {
      if (found[m].piece == piece_of_dof[d])
        modes(d, static_cast<Eigen::Index>(m)) = q.row(d).dot(found[m].combination.transpose());
    }
  }
  return modes;
}

template Eigen::MatrixXd rigid_modes<1>(const Body<1>&, const LinearOperator&, const Eigen::VectorXd&);
template Eigen::MatrixXd rigid_modes<2>(const Body<2>&, const LinearOperator&, const Eigen::VectorXd&);
template Eigen::MatrixXd rigid_modes<3>(const Body<3>&, const LinearOperator&, const Eigen::VectorXd&);

}  // namespace perimode
