#include <gyrostat/analysis/sensitivity/designs.hpp>

#include <algorithm>
#include <cassert>
#include <numeric>

#include <boost/random/sobol.hpp>

#include <gyrostat/core/random.hpp>

namespace gyrostat {
namespace {

/// Uniform deviates of a design, one after the other; `part` keeps apart what is drawn in parts.
class Uniforms {
 public:
  Uniforms(const DesignSource& source, std::uint32_t part)
      : stream_(source.seed, part, "design/" + source.name) {}

  double operator()() { return stream_.uniform(next_++); }
  std::size_t below(std::size_t limit) {
    return static_cast<std::size_t>((*this)() * static_cast<double>(limit));
  }

 private:
  NormalStream stream_;
  std::uint64_t next_ = 0;
};

/// The numbers 0, 1, ... in a random order.
std::vector<std::size_t> shuffled(std::size_t count, Uniforms& uniform) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[uniform.below(i)]);
  return order;
}

}  // namespace

Points latin_hypercube(std::size_t points, std::size_t parameters, const DesignSource& source) {
  Points design(points, std::vector<double>(parameters));
  for (std::size_t p = 0; p < parameters; ++p) {
    Uniforms uniform(source, static_cast<std::uint32_t>(p));
    const auto slices = shuffled(points, uniform);
    for (std::size_t i = 0; i < points; ++i)
      design[i][p] = (static_cast<double>(slices[i]) + uniform()) / static_cast<double>(points);
  }
  return design;
}

Points sobol_sequence(std::size_t points, std::size_t parameters, const DesignSource& source) {
  using Engine = boost::random::sobol_engine<std::uint32_t, 32>;
  Engine engine(parameters);
  Uniforms uniform(source, 0);
  std::vector<std::uint32_t> shift(parameters);
  for (auto& bits : shift) bits = static_cast<std::uint32_t>(uniform() * 0x1p32);
  Points design(points, std::vector<double>(parameters));
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t p = 0; p < parameters; ++p) {
      const std::uint32_t bits =
          i == 0 ? 0U : engine();  // Boost's sequence leaves out the point at 0
      design[i][p] = (static_cast<double>(bits ^ shift[p]) + 0.5) * 0x1p-32;
    }
  return design;
}

Points one_at_a_time(const std::vector<double>& base) {
  Points design = {base};
  for (std::size_t p = 0; p < base.size(); ++p)
    for (const double end : {0.0, 1.0}) {
      design.push_back(base);
      design.back()[p] = end;
    }
  return design;
}

double morris_step(std::size_t levels) {
  return 0.5 * static_cast<double>(levels) / static_cast<double>(levels - 1);
}

Points morris_trajectories(std::size_t trajectories, std::size_t levels, std::size_t parameters,
                           const DesignSource& source) {
  assert(levels >= 2 && levels % 2 == 0);
  Points design;
  for (std::size_t t = 0; t < trajectories; ++t) {
    Uniforms uniform(source, static_cast<std::uint32_t>(t));
    std::vector<std::size_t> level(parameters);
    for (auto& l : level) l = uniform.below(levels);
    const auto add = [&] {
      auto& point = design.emplace_back();
      for (const auto l : level)
        point.push_back(static_cast<double>(l) / static_cast<double>(levels - 1));
    };
    add();
    for (const auto p : shuffled(parameters, uniform)) {
      level[p] = (level[p] + levels / 2) % levels;  // the one way that stays on the grid
      add();
    }
  }
  return design;
}

Points saltelli_rows(std::size_t rows, std::size_t parameters, const DesignSource& source) {
  Points design;
  for (std::size_t r = 0; r < rows; ++r) {
    Uniforms uniform(source, static_cast<std::uint32_t>(r));
    std::vector<double> a(parameters), b(parameters);
    for (double& x : a) x = uniform();
    for (double& x : b) x = uniform();
    design.push_back(a);
    design.push_back(b);
    for (std::size_t p = 0; p < parameters; ++p) {
      design.push_back(a);
      design.back()[p] = b[p];
    }
  }
  return design;
}

}  // namespace gyrostat
