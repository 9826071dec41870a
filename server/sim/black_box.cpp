#include "sim/black_box.hpp"

#include <sstream>

#include "core/file.hpp"

namespace ream::sim {

BlackBox::BlackBox(size_t ticks) : reports_(ticks) {}

void BlackBox::remember(const record::TickReport& report) noexcept {
  reports_[count_++ % reports_.size()] = report;
}

void BlackBox::write(const std::filesystem::path& path) const {
  std::ostringstream out;
  out << "tick,lateness_us,read_us,step_us,write_us,link,spindle_on,paused,stale,engaged_points,thrust_n,"
         "hand_force_n,feed_rate_mm_s,density_g_cc,"
         "handle_x_mm,handle_y_mm,handle_z_mm,tool_x_mm,tool_y_mm,tool_z_mm,changed_bricks\n";
  for (size_t i = count_ - size(); i < count_; ++i) {
    const record::TickReport& r = reports_[i % reports_.size()];
    const Vec3 &handle = r.world_from_handle.translation_mm, &tool = r.world_from_tool.translation_mm;
    const TickTiming& t = r.timing;
    out << r.tick << ',' << t.lateness_us << ',' << t.read_us << ',' << t.step_us << ',' << t.write_us << ','
        << to_text(r.link) << ',' << r.spindle_on << ',' << r.paused << ',' << r.stale << ','
        << r.engaged_points << ',' << r.thrust_n << ',' << r.hand_force_n.norm() << ',' << r.feed_rate_mm_s
        << ',' << r.density_g_cc << ',' << handle.x() << ',' << handle.y() << ',' << handle.z() << ','
        << tool.x() << ',' << tool.y() << ',' << tool.z() << ',' << r.changed_bricks << '\n';
  }
  write_file_atomically(path, out.str());
}

}  // namespace ream::sim
