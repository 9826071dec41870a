/* A score: 100 points for the planned depth, fewer for each tenth of a millimetre beside it, and a word about
 * force. */
#include <math.h>
#include <ream_plugin.h>
#include <stdio.h>
#include <string.h>

static const double points_per_mm = 40.0, pass_points = 60.0, hard_push_n = 120.0;

/* Not a number where it is missing. */
static double value_of(const ream_metric* metrics, size_t count, const char* name) {
  for (size_t i = 0; i < count; ++i)
    if (strcmp(metrics[i].name, name) == 0) return metrics[i].value;
  return NAN;
}

static void judge(const ream_metric* metrics, size_t count, ream_score* score) {
  const double depth_error_mm = value_of(metrics, count, "depth_error_mm");
  const double peak_n = value_of(metrics, count, "axial_thrust_peak_n");
  if (isnan(depth_error_mm)) {
    score->outcome = -1;
    snprintf(score->lines[score->line_count++], REAM_SCORE_LINE_BYTES, "nothing was reamed to the planned depth");
    return;
  }
  score->points = fmax(0.0, 100.0 - points_per_mm * fabs(depth_error_mm));
  score->outcome = score->points >= pass_points;
  snprintf(score->lines[score->line_count++], REAM_SCORE_LINE_BYTES, "%.1f mm beside the planned depth",
           fabs(depth_error_mm));
  if (peak_n > hard_push_n)
    snprintf(score->lines[score->line_count++], REAM_SCORE_LINE_BYTES, "push less: %.0f N at most", peak_n);
}

static const ream_score_model score = {sizeof(ream_score_model), judge};

REAM_PLUGIN_EXPORT const ream_plugin_description ream_plugin = {
    REAM_PLUGIN_ABI, sizeof(ream_plugin_description), "depth-alone", "1.0", NULL, &score, NULL};
