#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap {

Bins::Bins(const std::vector<double>& coordinate, const std::vector<Span>& spans,
           const std::vector<double>& edges, std::size_t fewest) {
  if (edges.size() < 2) return;
  std::vector<std::size_t> counts(edges.size() - 1, 0);
  const auto for_each = [&](const auto& use) {
    for (const auto& span : spans)
      for (std::size_t i = span.first; i < span.last; ++i) {
        const double c = coordinate[i];
        if (is_missing(c) || c < edges.front() || c > edges.back()) continue;
        const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, c);
        use(i, static_cast<std::size_t>(above - edges.begin()) - 1);
      }
  };
  for_each([&](std::size_t, std::size_t bin) { ++counts[bin]; });
  std::vector<std::uint32_t> kept(counts.size(), 0);
  for (std::size_t b = 0; b < counts.size(); ++b)
    if (counts[b] >= fewest) {
      kept[b] = static_cast<std::uint32_t>(at_.size());
      at_.push_back({edges[b], edges[b + 1]});
    }
  for_each([&](std::size_t i, std::size_t bin) {
    if (counts[bin] >= fewest) entries_.push_back({static_cast<std::uint32_t>(i), kept[bin]});
  });
}

std::vector<double> quantile_edges(const std::vector<double>& values,
                                   const std::vector<Span>& spans, std::size_t count) {
  std::vector<double> sorted;
  for (const auto& span : spans)
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(values[i])) sorted.push_back(values[i]);
  if (sorted.size() < 2 * count) return {};
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> edges;
  for (std::size_t k = 0; k <= count; ++k) edges.push_back(sorted[k * (sorted.size() - 1) / count]);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<double> rate_edges(const std::vector<double>& rate_dps) {
  double fastest = 0.0;
  for (const double rate : rate_dps) fastest = std::max(fastest, std::abs(rate));
  std::vector<double> edges;
  for (double edge = 1.001 * fastest; edge > 0.1; edge *= edge > 0.5 * fastest ? 0.85 : 0.6)
    edges.push_back(edge);
  edges.push_back(0.05);
  const std::size_t half = edges.size();
  for (std::size_t k = half; k-- > 0;) edges.push_back(-edges[k]);
  std::reverse(edges.begin(), edges.end());
  return edges;
}

std::vector<double> even_edges(double low, double high, std::size_t count) {
  std::vector<double> edges(count + 1);
  for (std::size_t k = 0; k <= count; ++k)
    edges[k] = low + (high - low) * static_cast<double>(k) / static_cast<double>(count);
  return edges;
}

}  // namespace gyrostat::gap
