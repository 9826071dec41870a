#include "session/annotation.hpp"

#include <cmath>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/new_id.hpp"

namespace ream::session {

record::ops::Annotation annotation_op(const NewAnnotation& note, uint32_t ticks) {
  record::ops::Annotation op;
  op.tick = ticks;
  if (note.at_s) {
    const double tick = std::round(*note.at_s / tick_s);
    if (tick > ticks)
      throw Error(ErrorKind::invalid_input, "at_s is " + std::to_string(*note.at_s) +
                                                ", but the session has only " +
                                                std::to_string(ticks * tick_s) + " s so far");
    op.tick = static_cast<uint32_t>(tick);
  }
  op.utc = utc_now();
  op.author = note.author;
  op.words = note.words;
  if (note.place_mm) {
    op.has_place = 1;
    op.x_mm = note.place_mm->x();
    op.y_mm = note.place_mm->y();
    op.z_mm = note.place_mm->z();
  }
  return op;
}

Annotation annotation_of(const record::ops::Annotation& op) {
  Annotation annotation{op.utc, op.words, op.author, op.tick * tick_s, {}};
  if (op.has_place != 0) annotation.place_mm = Vec3(op.x_mm, op.y_mm, op.z_mm);
  return annotation;
}

}  // namespace ream::session
