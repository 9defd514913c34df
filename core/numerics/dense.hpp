#pragma once

#include <Eigen/Core>

/// Decompositions of matrices whose size is known when the program runs. Each is a long program of
/// templates, so it is compiled here once, for all rooms.
namespace gyrostat {

/// L with A = L L^T, lower triangular, of a positive definite A.
Eigen::MatrixXd cholesky_root(const Eigen::MatrixXd& A);

/// W = L^-1, of which W^T W is the inverse of a positive definite A = L L^T.
Eigen::MatrixXd whitener_of(const Eigen::MatrixXd& A);

/// Square roots R of a positive semidefinite A = R R^T; pivots that rounding made negative are 0.
Eigen::MatrixXd semidefinite_root(const Eigen::MatrixXd& A);

/// x with A x = b, of a symmetric A that need not be definite: P^T L D L^T P with pivots.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// What else the same factors tell of a symmetric A.
struct SymmetricInverse {
  Eigen::MatrixXd inverse;
  Eigen::VectorXd pivots;  ///< D
  bool positive = false;   ///< the factorisation went through, and no pivot is negative
};
SymmetricInverse invert_symmetric(const Eigen::MatrixXd& A);

/// argmin |A x - b| by Householder reflections with column pivots, and the diagonal of R over the
/// columns that are not dependent on others.
struct LeastSquares {
  Eigen::VectorXd solution;
  Eigen::VectorXd pivots;
  Eigen::Index rank = 0;
};
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Of all x that minimise |A x - b| the shortest, and the matrix that gives it.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);

/// A = V diag(values) V^T of a symmetric A, the least value first.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

/// exp(A), by scaling, a Pade approximation and squaring (Higham, SIAM J. Matrix Anal. Appl. 26,
/// 2005).
Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd& A);

}  // namespace gyrostat
