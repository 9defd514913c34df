#include <gyrostat/analysis/search/box_search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gyrostat {
namespace {

using Point = std::vector<double>;  // in the unit cube

struct Vertex {
  Point point;
  double objective;
};

/// Radical inverse of `index`, the coordinate of Halton's sequence in the given prime base.
double radical_inverse(int index, int base) {
  double inverse = 0.0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) inverse += digit * (index % base);
  return inverse;
}

Point halton(int index, std::size_t dimensions) {
  static constexpr std::array primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  Point point(dimensions);
  for (std::size_t d = 0; d < dimensions; ++d)
    point[d] = radical_inverse(index, primes[d % primes.size()]);
  return point;
}

/// from + step (to - from), clipped to the cube.
Point along(const Point& from, const Point& to, double step) {
  Point point(from.size());
  for (std::size_t d = 0; d < point.size(); ++d)
    point[d] = std::clamp(from[d] + step * (to[d] - from[d]), 0.0, 1.0);
  return point;
}

class Search {
 public:
  Search(const std::vector<SearchRange>& ranges, int evaluations,
         const std::function<double(const std::vector<double>&)>& objective)
      : ranges_(ranges), left_(evaluations), objective_(objective) {}

  bool exhausted() const { return left_ <= 0; }

  Vertex evaluate(const Point& point) {
    if (exhausted()) return {point, std::numeric_limits<double>::infinity()};
    --left_;
    ++result_.evaluations;
    std::vector<double> values(ranges_.size());
    for (std::size_t d = 0; d < values.size(); ++d) values[d] = ranges_[d].at(point[d]);
    double objective = objective_(values);
    if (std::isnan(objective)) objective = std::numeric_limits<double>::infinity();
    if (result_.values.empty() || objective < result_.objective) {
      result_.values = values;
      result_.objective = objective;
      best_ = point;
    }
    return {point, objective};
  }

  void scatter(int points) {
    for (int i = 1; i <= points && !exhausted(); ++i) evaluate(halton(i, ranges_.size()));
  }

  void descend() {
    std::vector<Vertex> simplex = {{best_, result_.objective}};
    for (std::size_t d = 0; d < best_.size(); ++d) {
      Point corner = best_;
      corner[d] += corner[d] > 0.5 ? -0.15 : 0.15;
      simplex.push_back(evaluate(corner));
    }
    while (!exhausted()) contract_or_reflect(simplex);
  }

  const SearchResult& result() const { return result_; }

 private:
  void contract_or_reflect(std::vector<Vertex>& simplex) {
    std::stable_sort(simplex.begin(), simplex.end(),
                     [](const Vertex& a, const Vertex& b) { return a.objective < b.objective; });
    Point centre(best_.size(), 0.0);
    for (std::size_t v = 0; v + 1 < simplex.size(); ++v)
      for (std::size_t d = 0; d < centre.size(); ++d)
        centre[d] += simplex[v].point[d] / static_cast<double>(simplex.size() - 1);
    Vertex& worst = simplex.back();
    const double second_worst = simplex[simplex.size() - 2].objective;

    const Vertex reflected = evaluate(along(centre, worst.point, -1.0));
    if (reflected.objective < simplex.front().objective) {
      const Vertex expanded = evaluate(along(centre, worst.point, -2.0));
      worst = expanded.objective < reflected.objective ? expanded : reflected;
    } else if (reflected.objective < second_worst) {
      worst = reflected;
    } else {
      const Vertex contracted = evaluate(along(centre, worst.point, 0.5));
      if (contracted.objective < worst.objective) {
        worst = contracted;
      } else {
        for (std::size_t v = 1; v < simplex.size(); ++v)
          simplex[v] = evaluate(along(simplex.front().point, simplex[v].point, 0.5));
      }
    }
  }

  const std::vector<SearchRange>& ranges_;
  int left_;
  const std::function<double(const std::vector<double>&)>& objective_;
  Point best_;
  SearchResult result_;
};

}  // namespace

double SearchRange::at(double fraction) const {
  const double value =
      low > 0.0 ? low * std::pow(high / low, fraction) : std::lerp(low, high, fraction);
  return std::clamp(whole ? std::round(value) : value, low, high);
}

SearchResult box_search(const std::vector<SearchRange>& ranges, int evaluations,
                        const std::function<double(const std::vector<double>&)>& objective) {
  Search search(ranges, evaluations, objective);
  if (ranges.empty()) {
    search.evaluate({});
    return search.result();
  }
  search.scatter(std::max(1, evaluations / 2));
  search.descend();
  return search.result();
}

}  // namespace gyrostat
