#include "app/setup_wizard.hpp"

#include <cstdio>
#include <cstdlib>
#include <istream>
#include <ostream>

#include "core/error.hpp"

namespace ream::app {
namespace {

constexpr int still_looks = 20, look_ms = 50;
constexpr double still_mm = 2.0;

class Wizard {
 public:
  Wizard(std::istream& in, std::ostream& out, const HandlePlace& place,
         const std::function<void(int)>& wait_ms)
      : in_(in), out_(out), place_(place), wait_ms_(wait_ms) {}

  Mat3 axes() {
    for (;;) try {
        out_ << "Sit as you will train. The device gives no force now.\n";
        const Vec3 right = motion("to your right"), up = motion("up"), towards = motion("towards you");
        return device::person_from_motions(right, up, towards);
      } catch (const Error& e) {
        if (e.kind() != ErrorKind::invalid_input || left_) throw;
        out_ << "That did not work: " << e.what() << ". Once more, please.\n";
      }
  }

  device::Hand hand(device::Hand usual) {
    for (;;) {
      const std::string answer =
          ask(std::string("Which hand holds the tool, left or right? [") + to_text(usual) + "] ");
      if (answer.empty()) return usual;
      if (answer == "left" || answer == "l") return device::Hand::left;
      if (answer == "right" || answer == "r") return device::Hand::right;
      out_ << "Please answer left or right.\n";
    }
  }

  double scale(double usual) {
    char shown[32];
    std::snprintf(shown, sizeof shown, "%g", usual);
    for (;;) {
      const std::string answer =
          ask(std::string("How many mm shall the tool move for each mm of the handle? [") + shown + "] ");
      if (answer.empty()) return usual;
      char* end = nullptr;
      const double scale = std::strtod(answer.c_str(), &end);
      if (*end == '\0' && scale >= device::DeviceSetup::min_scale && scale <= device::DeviceSetup::max_scale)
        return scale;
      out_ << "Please give a number from 0.05 to 20.\n";
    }
  }

 private:
  std::string ask(const std::string& question) {
    out_ << question << std::flush;
    std::string answer;
    left_ = !std::getline(in_, answer);
    if (left_) throw Error(ErrorKind::invalid_input, "the set-up was left; nothing was written");
    return answer;
  }

  /// Where the handle is once it has been still for a second.
  Vec3 still_place() {
    Vec3 from = place_();
    for (int still = 0; still < still_looks; ++still) {
      wait_ms_(look_ms);
      const Vec3 now = place_();
      if ((now - from).norm() <= still_mm) continue;
      from = now;
      still = 0;
    }
    return from;
  }

  Vec3 motion(const std::string& direction) {
    out_ << "Keep the handle still ..." << std::flush;
    const Vec3 from = still_place();
    ask(" thank you. Now move it " + direction + ", 5 to 10 cm, and press Enter there. ");
    return place_() - from;
  }

  std::istream& in_;
  std::ostream& out_;
  const HandlePlace& place_;
  const std::function<void(int)>& wait_ms_;
  bool left_ = false;
};

}  // namespace

device::DeviceSetup ask_for_setup(std::istream& in, std::ostream& out, const device::DeviceSetup& setup,
                                  const HandlePlace& place, const std::function<void(int)>& wait_ms) {
  Wizard wizard(in, out, place, wait_ms);
  device::DeviceSetup wanted = setup;
  wanted.person_from_device = wizard.axes();
  wanted.hand = wizard.hand(setup.hand);
  wanted.scale = wizard.scale(setup.scale);
  return wanted;
}

}  // namespace ream::app
