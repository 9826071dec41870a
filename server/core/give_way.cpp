#include "core/give_way.hpp"

#include <sched.h>

namespace ream {

void give_way() {
  const sched_param lowest{};
  ::sched_setscheduler(0, SCHED_BATCH, &lowest);
}

}  // namespace ream
