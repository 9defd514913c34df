#pragma once

#include <map>
#include <string>

#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat {

/// One look for each method of a study, the same in every picture. Where there are more methods
/// than colours, the later ones are dashed or hollow.
class MethodColours {
 public:
  explicit MethodColours(const Study& study);
  const std::string& of(const std::string& method) const { return looks_.at(method).colour; }
  /// A mark of the method, in its colour and under its name.
  Mark mark(Mark::Kind kind, const std::string& method) const;

 private:
  struct Look {
    std::string colour;
    bool dashed = false;
  };
  std::map<std::string, Look> looks_;
};

}  // namespace gyrostat
