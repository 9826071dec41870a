#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "study/validity_report.hpp"

namespace ream::test {

/// A study whose persons, arms and raters are drawn at random from known laws.
struct SimulatedStudy {
  uint32_t seed = 1;
  int experts = 10, novices = 10, raters = 2;
  double expert_skill = 1.5;  ///< over that of novices, in standard deviations of persons
  double trained_gain = 1.0;  ///< of arm "guided" over arm "plain", after training
  bool trial =
      true;  ///< phases: pre, six of training (experts: one), for novices in two arms post, retention
  double missing_ratings = 0.0;  ///< share
};

class StudySimulator {
 public:
  explicit StudySimulator(const SimulatedStudy& what) : what_(what), random_(what.seed) {
    for (const char* scale : {"flow", "force", "plan"})
      input_.items.push_back({scale, study::ItemKind::scale});
    for (const char* check : {"depth kept", "vault kept"})
      input_.items.push_back({check, study::ItemKind::check});
    for (int i = 0; i < what.experts; ++i) add_expert("E" + std::to_string(100 + i));
    for (int i = 0; i < what.novices; ++i) add_novice("N" + std::to_string(100 + i), i);
    for (const char* level : {"intermediate", ""})
      add_session(std::string("X") + level, level, "", "", 0, normal());
  }
  const study::ValidityInput& input() const { return input_; }

 private:
  double normal() { return bell_(random_); }

  void add_expert(const std::string& code) {
    const double skill = what_.expert_skill + normal();
    for (int attempt = 1; attempt <= 2; ++attempt)
      add_session(code, "expert", "", !what_.trial ? "" : attempt == 1 ? "pre" : "training", attempt, skill);
  }

  void add_novice(const std::string& code, int number) {
    const double skill = normal();
    if (!what_.trial) {
      for (int attempt = 1; attempt <= 1 + number % 3; ++attempt)
        add_session(code, "novice", "", "", attempt, skill);
      return;
    }
    const bool guided = number % 2 == 0;
    constexpr int training = 6;
    for (int i = 0; i < training + 3; ++i) {
      if (i == training + 2 && number == 1) continue;  // did not come again
      const char* const phase = i == 0              ? "pre"
                                : i <= training     ? "training"
                                : i == training + 1 ? "post"
                                                    : "retention";
      const double learned = (guided ? what_.trained_gain : 0.0) * std::min(1.0, i / (training + 1.0));
      add_session(code, "novice", guided ? "guided" : "plain", phase, i + 1, skill + learned);
    }
  }

  void add_session(const std::string& code, const std::string& experience, const std::string& arm,
                   const std::string& phase, int attempt, double skill) {
    study::RatedSession session{
        "s" + std::to_string(1000 + input_.sessions.size()), code, experience, arm, phase, {}, attempt};
    const double today = skill + 0.5 * normal();
    const double practice = attempt > 0 ? 90.0 * std::exp(-0.6 * (attempt - 1)) : 0.0;
    session.measures["duration_s"] = 150.0 - 15.0 * today + practice + 3.0 * normal();
    session.measures["slips"] = std::max(0.0, std::round(3.0 - today + normal()));
    session.measures["setting_mm"] = 1.87;
    session.measures["noise_n"] = 20.0 + 5.0 * normal();
    if (std::uniform_real_distribution<double>()(random_) < 0.8)
      session.measures["offset, mm"] = std::abs(2.0 - 0.4 * today + 0.5 * normal());
    for (int rater = 0; rater < what_.raters; ++rater) rate(session.session, rater, today);
    input_.sessions.push_back(std::move(session));
  }

  void rate(const std::string& session, int rater, double seen) {
    const std::string name = "R" + std::to_string(rater);
    for (const study::RatedItem& item : input_.items) {
      const double felt = seen + 0.3 * rater + 0.8 * normal();
      const double value = item.kind == study::ItemKind::scale
                               ? std::clamp(std::round(2.5 + 0.8 * felt), 1.0, 5.0)
                               : (felt > 0.3 ? 1.0 : 0.0);
      if (std::uniform_real_distribution<double>()(random_) >= what_.missing_ratings)
        input_.ratings.push_back({name, session, item.id, value});
    }
  }

  SimulatedStudy what_;
  std::mt19937 random_;
  std::normal_distribution<double> bell_;
  study::ValidityInput input_;
};

inline study::ValidityInput simulated_study(const SimulatedStudy& what) {
  return StudySimulator(what).input();
}

}  // namespace ream::test
