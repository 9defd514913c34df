#include <gyrostat/core/numerics/dense.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <unsupported/Eigen/MatrixFunctions>

namespace gyrostat {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Products of matrices are summed in blocks as long as a cache holds: of this processor's, they
/// would have other last bits on another.
[[maybe_unused]] const bool same_blocks_everywhere = [] {
  Eigen::setCpuCacheSizes(32 * 1024, 1024 * 1024, 8 * 1024 * 1024);
  return true;
}();

}  // namespace

MatrixXd cholesky_root(const MatrixXd& A) { return A.llt().matrixL(); }

MatrixXd whitener_of(const MatrixXd& A) {
  return A.llt().matrixL().solve(MatrixXd::Identity(A.rows(), A.cols()));
}

MatrixXd semidefinite_root(const MatrixXd& A) {
  const auto factor = A.ldlt();
  MatrixXd root = factor.matrixL();
  root = factor.transpositionsP().transpose() *
         (root * factor.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal()).eval();
  return root;
}

VectorXd solve_symmetric(const MatrixXd& A, const VectorXd& b) { return A.ldlt().solve(b); }
MatrixXd solve_symmetric(const MatrixXd& A, const MatrixXd& b) { return A.ldlt().solve(b); }

SymmetricInverse invert_symmetric(const MatrixXd& A) {
  const auto factor = A.ldlt();
  const MatrixXd identity = MatrixXd::Identity(A.rows(), A.cols());
  return {factor.solve(identity), factor.vectorD(),
          factor.info() == Eigen::Success && factor.isPositive()};
}

LeastSquares least_squares(const MatrixXd& A, const VectorXd& b) {
  const auto qr = A.colPivHouseholderQr();
  return {qr.solve(b), qr.matrixR().diagonal(), qr.rank()};
}

VectorXd shortest_least_squares(const MatrixXd& A, const VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

MatrixXd pseudo_inverse(const MatrixXd& A) {
  return A.completeOrthogonalDecomposition().pseudoInverse();
}

SymmetricEigen symmetric_eigen(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

MatrixXd matrix_exponential(const MatrixXd& A) { return A.exp(); }

}  // namespace gyrostat
