#pragma once

#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include <gyrostat/experiments/findings/recording_page.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {

/// `--html` and `--svg` of a verb that has one picture of a recording.
struct PictureOption {
  std::string html, svg;

  void add_to(CLI::App* verb) {
    verb->add_option("--html", html, "write a page with picture and tables")->type_name("FILE");
    verb->add_option("--svg", svg, "write the picture")->type_name("FILE");
  }

  bool wanted() const { return !html.empty() || !svg.empty(); }

  /// Before any work: that neither is the recording itself, or where nothing can be written.
  void check(const std::string& recording) const {
    for (const auto& out : {html, svg})
      if (!out.empty()) require_writable(out, recording);
  }

  void write(const std::string& name, const Picture& picture, std::span<const Table> tables) const {
    if (!html.empty()) write_atomically(html, recording_page(name, picture, tables));
    if (!svg.empty()) write_atomically(svg, picture_file(picture));
  }
};

}  // namespace gyrostat::cli
