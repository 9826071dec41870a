/* A feed model: the law of the built-in model `edge`, to the bit. Change load() to what you have measured. */
#include <ream_plugin.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;
static const double reference_thrust_n = 52.0; /* of the thesis' experiments */
static const double start_threshold_n = 1.0;   /* below it the lips only rub */
static const double lips = 5.0, lip_height_mm = 0.4;
static const double blocked_n_s_mm = 1e7;

/* What load() needs of a session's settings, computed ahead. */
typedef struct {
  double threshold_share, tangential_ratio;
  double load_n_mm; /* along the engaged edge */
  double slower;    /* than the reference spindle in the usual specimen */
  double max_feed_mm_s;
} law;

static double larger(double a, double b) { return a < b ? b : a; }
static double smaller(double a, double b) { return b < a ? b : a; }

static void* create(const ream_feed_settings* settings) {
  const double reference_spindle_rad_s = 156.0 * (2.0 * pi / 60.0);
  law* made = malloc(sizeof *made);
  if (made == NULL) abort();
  made->threshold_share = settings->edge_threshold_share;
  made->tangential_ratio = settings->tangential_ratio;
  made->load_n_mm = reference_thrust_n / settings->edge_reference_mm;
  made->slower = reference_spindle_rad_s / (settings->spindle_rad_s * settings->specimen_factor);
  made->max_feed_mm_s = lip_height_mm * lips * settings->spindle_rad_s / (2.0 * pi);
  return made;
}

static void load(const void* model, const ream_engaged_bone* bone, ream_cutting_load* load) {
  const law* l = model;
  const double thrust_n = larger(bone->thrust_n, start_threshold_n);
  const double left_n = thrust_n - l->threshold_share * l->load_n_mm * bone->edge_mm;
  load->tangential_ratio = l->tangential_ratio;
  load->resistance_n_s_mm = blocked_n_s_mm;
  if (left_n <= 0.0) return;
  const double resistance_n_s_mm = l->load_n_mm * bone->edge_mm * bone->resistance_s_mm * l->slower;
  load->resistance_n_s_mm =
      smaller(blocked_n_s_mm, resistance_n_s_mm * (1.0 - l->threshold_share) * thrust_n / left_n);
  load->resistance_n_s_mm = larger(load->resistance_n_s_mm, thrust_n / l->max_feed_mm_s);
}

static const ream_feed_model feed = {sizeof(ream_feed_model), create, free, load};

REAM_PLUGIN_EXPORT const ream_plugin_description ream_plugin = {
    REAM_PLUGIN_ABI, sizeof(ream_plugin_description), "edge-law", "1.0", &feed, NULL, NULL};
