#pragma once

#include <array>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/findings/cell_summary.hpp>

namespace gyrostat {

/// One way in which a filter may contradict what it states of itself.
struct ConsistencyTest {
  std::string method, test;
  double value = no_value, expected = no_value;
  double low = no_value,
         high = no_value;  ///< where a consistent filter's value lies, all tests together
  std::string verdict;  ///< consistent, over-confident, conservative, white, correlated, skewed; –
                        ///< : no value
};

/// Seven tests of each method of a cell, with a probability of 5 % that a filter consistent in all
/// of them fails any, over all tests of all methods (Bonferroni):
///   nis           mean of nu^2 / S over all innovations, chi-squared
///   lag_1         autocorrelation of successive innovations, normal
///   ljung_box     of lags 1 to 10, mean over trials, chi-squared
///   pit           chi-squared of the PIT histogram's ten shares, nine degrees of freedom
///   nees          mean over time and trials, Hall's t over trials, for errors of a trial hang
///                 together
///   nees_end      at the last sample, over trials, chi-squared (ANEES)
///   within_3_sigma
///                 share of time, Hall's t over trials
std::vector<ConsistencyTest> consistency_tests(const Cell& cell, const CellSummary& summary);

/// The shares of a method's innovations in the tenths of the distribution that it foretold.
std::array<double, 10> pit_histogram(const CellSummary& summary, std::size_t method);

/// The verdicts, one row a method.
Table consistency_table(const Cell& cell, const CellSummary& summary);
/// Every test with its bounds, and the PIT histograms.
std::vector<Table> consistency_details(const Cell& cell, const CellSummary& summary);

}  // namespace gyrostat
