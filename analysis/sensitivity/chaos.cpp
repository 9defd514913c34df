#include <gyrostat/analysis/sensitivity/chaos.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace gyrostat {
namespace {

using Degrees = std::vector<std::uint8_t>;

constexpr double hyperbolic = 0.75;
constexpr std::array bounds = {1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20};
/// More products than these are not looked at, whatever their degree.
constexpr std::size_t most_products = 3000;

/// The polynomials of degree 0, 1, ... at coordinate u.
void polynomials(double u, std::size_t levels, std::span<double> p) {
  const auto count = static_cast<double>(levels);
  const double x = levels == 0
                       ? 2.0 * u - 1.0
                       : (2.0 * std::min(std::floor(u * count), count - 1.0) + 1.0) / count - 1.0;
  const auto b = [&](std::size_t degree) {
    const auto n = static_cast<double>(degree);
    const double share = levels == 0 ? 0.0 : n / count;
    return n / std::sqrt(4.0 * n * n - 1.0) * std::sqrt(1.0 - share * share);
  };
  p[0] = 1.0;
  for (std::size_t n = 0; n + 1 < p.size(); ++n) {
    // Of so many levels there is no polynomial of higher degree.
    if (levels != 0 && n + 1 >= levels) {
      std::fill(p.begin() + static_cast<std::ptrdiff_t>(n) + 1, p.end(), 0.0);
      return;
    }
    p[n + 1] = (x * p[n] - (n == 0 ? 0.0 : b(n) * p[n - 1])) / b(n + 1);
  }
}

/// Every parameter's polynomials at a point.
class Basis {
 public:
  Basis(std::span<const double> point, const std::vector<std::size_t>& levels, std::size_t degree)
      : stride_(degree + 1), values_(point.size() * stride_) {
    for (std::size_t p = 0; p < point.size(); ++p)
      polynomials(point[p], levels[p], std::span(values_).subspan(p * stride_, stride_));
  }
  double operator()(const Degrees& degrees) const {
    double product = 1.0;
    for (std::size_t p = 0; p < degrees.size(); ++p)
      if (degrees[p] != 0) product *= values_[p * stride_ + degrees[p]];
    return product;
  }

 private:
  std::size_t stride_;
  std::vector<double> values_;
};

std::size_t highest(const std::vector<ChaosTerm>& terms) {
  std::size_t degree = 0;
  for (const auto& term : terms)
    for (const auto d : term.degrees) degree = std::max<std::size_t>(degree, d);
  return degree;
}

/// Products up to the bound, without the constant, from parameter p on; false where they are too
/// many.
bool add_products(Degrees& at, std::size_t p, double left, const std::vector<std::size_t>& levels,
                  std::vector<Degrees>& products) {
  if (p == at.size()) {
    if (std::any_of(at.begin(), at.end(), [](auto d) { return d != 0; })) products.push_back(at);
    return products.size() <= most_products;
  }
  for (std::uint8_t d = 0;; ++d) {
    const double spent = std::pow(d, hyperbolic);
    if (spent > left * (1.0 + 1e-12) || (levels[p] != 0 && d >= levels[p])) break;
    at[p] = d;
    if (!add_products(at, p + 1, left - spent, levels, products)) return false;
  }
  at[p] = 0;
  return true;
}

std::vector<Degrees> products_up_to(int bound, const std::vector<std::size_t>& levels) {
  std::vector<Degrees> products;
  Degrees at(levels.size(), 0);
  if (!add_products(at, 0, std::pow(bound, hyperbolic), levels, products)) products.clear();
  return products;
}

/// What least squares has chosen so far: an orthonormal basis of the chosen columns over the
/// points that are `used`, its continuation to the others, and the inverse of their triangular
/// factor.
class Pursuit {
 public:
  Pursuit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values,
          const Eigen::VectorXd& used)
      : columns_(columns),
        used_(used),
        size_(used.sum()),
        most_(std::min(columns.cols(), static_cast<Eigen::Index>(size_ / 2.0))),
        basis_(columns.rows(), most_),
        inverse_(Eigen::MatrixXd::Zero(most_, most_)),
        coordinates_(most_),
        rest_(values),
        leverage_(Eigen::VectorXd::Zero(columns.rows())),
        free_(static_cast<std::size_t>(columns.cols()), true) {
    add(0);
    spread_ = used_squares();
  }

  /// One product more; false where no more can be told.
  bool grow() {
    while (count_ < most_ && used_squares() > 1e-26 * spread_) {
      const Eigen::VectorXd correlated =
          columns_.transpose() * (rest_.array() * used_.array()).matrix();
      Eigen::Index next = -1;
      for (Eigen::Index c = 0; c < correlated.size(); ++c)
        if (free_[static_cast<std::size_t>(c)] &&
            (next < 0 || std::abs(correlated[c]) > std::abs(correlated[next])))
          next = c;
      if (next < 0) return false;
      if (add(next)) return true;
    }
    return false;
  }

  std::size_t terms() const { return static_cast<std::size_t>(count_); }
  /// Sum of the squares of what is left at the points that are not used.
  double unused_squares() const { return (rest_.array().square() * (1.0 - used_.array())).sum(); }
  double used_squares() const { return (rest_.array().square() * used_.array()).sum(); }

  /// Of the points that are used, each left out in turn, as a share of their variance.
  double left_out_error() const {
    const double squares =
        ((rest_.array() / (1.0 - leverage_.array()).max(1e-12)).square() * used_.array()).sum();
    // With C the columns' mean products, inverse_size_ is the trace of C^-1 / n.
    const double correction = size_ / (size_ - static_cast<double>(count_)) * (1.0 + inverse_size_);
    return spread_ > 0.0 ? squares / size_ * correction / (spread_ / (size_ - 1.0)) : 0.0;
  }

  const std::vector<Eigen::Index>& chosen() const { return chosen_; }
  Eigen::VectorXd coefficients() const {
    return inverse_.topLeftCorner(count_, count_).triangularView<Eigen::Upper>() *
           coordinates_.head(count_);
  }

 private:
  bool add(Eigen::Index c) {
    free_[static_cast<std::size_t>(c)] = false;
    const auto basis = basis_.leftCols(count_);
    Eigen::VectorXd column = columns_.col(c);
    const double whole = column.cwiseProduct(used_).norm();
    Eigen::VectorXd factors = Eigen::VectorXd::Zero(count_);
    for (int twice = 0; twice < 2; ++twice) {  // for orthogonality
      const Eigen::VectorXd more = basis.transpose() * column.cwiseProduct(used_);
      column -= basis * more;
      factors += more;
    }
    const double own = column.cwiseProduct(used_).norm();
    if (own < 1e-7 * whole) return false;  // the chosen ones hold it already
    column /= own;
    inverse_.col(count_).head(count_) =
        inverse_.topLeftCorner(count_, count_).triangularView<Eigen::Upper>() * (factors / -own);
    inverse_(count_, count_) = 1.0 / own;
    inverse_size_ += inverse_.col(count_).squaredNorm();
    coordinates_[count_] = column.cwiseProduct(used_).dot(rest_);
    rest_ -= column * coordinates_[count_];
    leverage_ += column.cwiseAbs2();
    basis_.col(count_++) = column;
    chosen_.push_back(c);
    return true;
  }

  const Eigen::MatrixXd& columns_;
  Eigen::VectorXd used_;  ///< 1 or 0
  double size_;
  Eigen::Index most_, count_ = 0;  ///< two points for a coefficient are needed at least
  Eigen::MatrixXd basis_, inverse_;
  Eigen::VectorXd coordinates_, rest_, leverage_;
  std::vector<bool> free_;
  std::vector<Eigen::Index> chosen_{};
  double inverse_size_ = 0.0, spread_ = 0.0;
};

/// The points that have a value, with every polynomial at them.
class Data {
 public:
  Data(const Points& points, std::span<const double> values, const std::vector<std::size_t>& levels)
      : levels_(levels) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::isfinite(values[i])) {
        known_.push_back(i);
        bases_.emplace_back(points[i], levels, static_cast<std::size_t>(bounds.back()));
      }
    values_.resize(static_cast<Eigen::Index>(known_.size()));
    for (std::size_t i = 0; i < known_.size(); ++i)
      values_[static_cast<Eigen::Index>(i)] = values[known_[i]];
  }

  const std::vector<std::size_t>& known() const { return known_; }
  const Eigen::VectorXd& values() const { return values_; }
  Eigen::VectorXd everywhere() const { return Eigen::VectorXd::Ones(values_.size()); }

  Eigen::MatrixXd columns(const std::vector<Degrees>& products) const {
    Eigen::MatrixXd columns(values_.size(), static_cast<Eigen::Index>(products.size()) + 1);
    columns.col(0).setOnes();
    for (Eigen::Index c = 1; c < columns.cols(); ++c)
      for (Eigen::Index i = 0; i < columns.rows(); ++i)
        columns(i, c) =
            bases_[static_cast<std::size_t>(i)](products[static_cast<std::size_t>(c) - 1]);
    return columns;
  }

  Chaos chaos(Pursuit& pursuit, const std::vector<Degrees>& products, std::size_t terms) const {
    while (pursuit.terms() < terms && pursuit.grow()) {
    }
    Chaos chaos{.levels = levels_,
                .terms = {{Degrees(levels_.size(), 0), 0.0}},
                .left_out_error = pursuit.left_out_error()};
    const auto coefficients = pursuit.coefficients();
    for (std::size_t k = 0; k < pursuit.terms(); ++k) {
      const auto c = static_cast<std::size_t>(pursuit.chosen()[k]);
      const double factor = coefficients[static_cast<Eigen::Index>(k)];
      if (c == 0)
        chaos.terms[0].coefficient = factor;
      else
        chaos.terms.push_back({products[c - 1], factor});
    }
    return chaos;
  }

 private:
  std::vector<std::size_t> levels_;
  std::vector<std::size_t> known_{};
  std::vector<Basis> bases_{};
  Eigen::VectorXd values_{};
};

/// Squared errors at the points left out, by number of terms less one, over all parts.
std::vector<double> left_out_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values,
                                     const std::vector<Eigen::VectorXd>& others) {
  std::vector<std::vector<double>> by_part;
  std::size_t longest = 0;
  for (const auto& used : others) {
    Pursuit pursuit(columns, values, used);
    auto& squares = by_part.emplace_back(1, pursuit.unused_squares());
    double least = squares.front();
    std::size_t least_at = 0;
    while (squares.size() < std::max<std::size_t>(20, 2 * least_at) && pursuit.grow()) {
      squares.push_back(pursuit.unused_squares());
      if (squares.back() >= least) continue;
      least = squares.back();
      least_at = squares.size();
    }
    longest = std::max(longest, squares.size());
  }
  std::vector<double> sums(longest, 0.0);
  for (const auto& squares : by_part)
    for (std::size_t k = 0; k < longest; ++k) sums[k] += squares[std::min(k, squares.size() - 1)];
  return sums;
}

}  // namespace

double Chaos::operator()(std::span<const double> point) const {
  const Basis basis(point, levels, highest(terms));
  double sum = 0.0;
  for (const auto& term : terms) sum += term.coefficient * basis(term.degrees);
  return sum;
}

double Chaos::variance() const {
  double sum = 0.0;
  for (std::size_t t = 1; t < terms.size(); ++t) sum += terms[t].coefficient * terms[t].coefficient;
  return sum;
}

namespace {

template <class Value>
ChaosParts parts_of(const Chaos& chaos, const Value& value) {
  ChaosParts parts{std::vector<double>(chaos.levels.size(), 0.0),
                   std::vector<double>(chaos.levels.size(), 0.0)};
  for (const auto& term : chaos.terms) {
    const double v = value(term);
    const auto others = std::count(term.degrees.begin(), term.degrees.end(), 0);
    const bool is_alone = static_cast<std::size_t>(others) + 1 == term.degrees.size();
    for (std::size_t p = 0; p < term.degrees.size(); ++p)
      if (term.degrees[p] != 0) {
        parts.in_all[p] += v;
        if (is_alone) parts.alone[p] += v;
      }
  }
  return parts;
}

}  // namespace

ChaosParts Chaos::variances() const {
  return parts_of(*this, [](const ChaosTerm& t) { return t.coefficient * t.coefficient; });
}

ChaosParts Chaos::parts(std::span<const double> point) const {
  const Basis basis(point, levels, highest(terms));
  return parts_of(*this, [&](const ChaosTerm& t) { return t.coefficient * basis(t.degrees); });
}

Chaos fit_chaos(const Points& points, std::span<const double> values,
                const std::vector<std::size_t>& levels, const ChaosSize& size) {
  const Data data(points, values, levels);
  if (data.known().size() < 4) return {.levels = levels, .terms = {{Degrees(levels.size(), 0), 0}}};
  const auto products = products_up_to(size.bound, levels);
  const auto columns = data.columns(products);
  Pursuit pursuit(columns, data.values(), data.everywhere());
  return data.chaos(pursuit, products, size.terms);
}

CrossedChaos fit_chaoses(const Points& points, std::span<const double> values,
                         const std::vector<std::size_t>& levels,
                         const std::vector<std::size_t>& part_of) {
  const Data data(points, values, levels);
  const std::size_t parts = 1 + *std::max_element(part_of.begin(), part_of.end());
  std::vector<Eigen::VectorXd> others(parts, data.everywhere());
  for (std::size_t i = 0; i < data.known().size(); ++i)
    others[part_of[data.known()[i]]][static_cast<Eigen::Index>(i)] = 0.0;
  const Chaos constant{.levels = levels, .terms = {{Degrees(levels.size(), 0), 0.0}}};
  CrossedChaos best{constant, std::vector<Chaos>(parts, constant)};
  if (std::any_of(others.begin(), others.end(), [](const auto& o) { return o.sum() < 4.0; }))
    return best;
  ChaosSize size;
  double least = std::numeric_limits<double>::infinity();
  std::size_t last = 0, worse = 0;
  for (const int bound : bounds) {
    const auto products = products_up_to(bound, levels);
    if (products.size() <= last || worse == 2) break;
    last = products.size();
    const auto squares = left_out_squares(data.columns(products), data.values(), others);
    const auto at = std::min_element(squares.begin(), squares.end());
    ++worse;
    if (*at >= least) continue;
    worse = 0;
    least = *at;
    size = {bound, static_cast<std::size_t>(at - squares.begin()) + 1};
  }
  const auto products = products_up_to(size.bound, levels);
  const auto columns = data.columns(products);
  for (std::size_t part = 0; part < parts; ++part) {
    Pursuit pursuit(columns, data.values(), others[part]);
    best.of_others[part] = data.chaos(pursuit, products, size.terms);
  }
  Pursuit pursuit(columns, data.values(), data.everywhere());
  best.of_all = data.chaos(pursuit, products, size.terms);
  return best;
}

}  // namespace gyrostat
