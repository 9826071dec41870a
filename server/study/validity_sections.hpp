#pragma once
#include <optional>
#include <string>
#include <vector>

#include "statistics/estimate.hpp"
#include "study/validity_report.hpp"

namespace ream::study {

/// The parts of a report. `sessions` are those of with_raters_total().

std::vector<ValidityLine> agreement_lines(const ValidityInput& input);
std::vector<ValidityLine> checklist_lines(const ValidityInput& input);
std::vector<ValidityLine> known_group_lines(const ValidityInput& input,
                                            const std::vector<RatedSession>& sessions);
std::vector<ValidityLine> correlation_lines(const std::vector<RatedSession>& sessions);
std::vector<ValidityLine> benchmark_lines(const std::vector<RatedSession>& sessions);
std::vector<ValidityLine> learning_lines(const std::vector<RatedSession>& sessions);
std::vector<ValidityLine> change_lines(const std::vector<RatedSession>& sessions);
std::vector<ValidityLine> arm_difference_lines(const std::vector<RatedSession>& sessions);

/// Adds a number, an interval ("name_low", "name_high"), both, or a sentence, unless it is empty or there
/// already.
void add_value(ValidityLine& line, const std::string& name, double value);
void add_interval(ValidityLine& line, const std::string& name,
                  const std::optional<statistics::Interval>& interval);
void add_estimate(ValidityLine& line, const std::string& name, double value,
                  const std::optional<statistics::Interval>& interval);
void add_note(ValidityLine& line, const std::string& note);

/// Of lines that have `name` (a p), its value among all of them by Holm, as name_holm.
void add_holm(std::vector<ValidityLine>& lines, const std::string& name);

}  // namespace ream::study
