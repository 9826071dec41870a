#include "fe/two_threads.hpp"

#include "core/crew.hpp"

namespace ream::fe {

void on_two_threads(size_t count, const std::function<void(size_t)>& work, const Progress& progress,
                    std::string_view step) {
  if (!step.empty()) progress(0.0, step);
  Crew crew(count > 1 ? 2 : 1);
  crew.run(
      count, [&](size_t i, int) { work(i); }, [&](double share) { progress(share, step); });
}

}  // namespace ream::fe
