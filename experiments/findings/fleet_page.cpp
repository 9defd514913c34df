#include <gyrostat/experiments/findings/fleet_page.hpp>

#include <fmt/format.h>

#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/experiments/findings/member_tables.hpp>
#include <gyrostat/experiments/findings/report/live_page.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat::gap {

std::string fleet_page(const std::vector<FleetMember>& members, const std::string& kind,
                       const std::vector<std::string>& pages, const std::string& name) {
  std::string head = fmt::format("<h1>{}</h1>\n", escaped(name));
  for (std::size_t k = 0; k < members.size(); ++k)
    head += fmt::format("<p><a href=\"{}\">{}</a>: {}</p>\n", escaped(pages[k]),
                        escaped(members[k].name), escaped(answer(members[k].diagnosis)));
  head += fmt::format("<p class=\"answer\">{}</p>\n", escaped(shared_in_words(members)));
  std::string numbers;
  for (const auto& table : member_tables(members, kind))
    if (!table.rows.empty()) numbers += html(table);
  return live_page(name, head, numbers);
}

}  // namespace gyrostat::gap
