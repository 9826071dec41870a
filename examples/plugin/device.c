/* A device: a handle without hardware, which a steady hand pushes away from the person. Put your hardware's own
 * calls in place of what computes here. */
#include <ream_plugin.h>
#include <stdio.h>
#include <stdlib.h>

static const double push_n = 2.5, damping_n_s_mm = 0.06, mass_kg = 0.2, tick_s = 1e-3, reach_mm = 60.0;

typedef struct {
  double away_mm, speed_mm_s, force_n; /* along -z: away from the person */
} handle;

static void* open_device(char* why, size_t why_bytes) {
  handle* made = calloc(1, sizeof *made);
  if (made == NULL) snprintf(why, why_bytes, "there is no memory for the handle");
  return made;
}

static int read_device(void* device, ream_handle_state* state) {
  handle* h = device;
  const double force_n = push_n - h->force_n - damping_n_s_mm * h->speed_mm_s;
  h->speed_mm_s += 1e3 * force_n / mass_kg * tick_s;
  h->away_mm += h->speed_mm_s * tick_s;
  if (h->away_mm > reach_mm) {
    h->away_mm = reach_mm;
    h->speed_mm_s = 0.0;
  }
  for (int i = 0; i < 3; ++i) state->rotation[4 * i] = 1.0;
  state->place_mm[2] = -h->away_mm;
  state->spindle_on = 1;
  state->deadman = 1;
  return REAM_DEVICE_OK;
}

static int write_device(void* device, const ream_handle_force* force) {
  ((handle*)device)->force_n = force->force_n[2]; /* towards the person: against the push */
  return REAM_DEVICE_OK;
}

static const ream_device device = {sizeof(ream_device),
                                   "steady-hand",
                                   "A simulated handle that is pushed with 2.5 N",
                                   3.3,  /* force_max_n */
                                   0.0,  /* torque_max_n_mm */
                                   0.4,  /* stiffness_max_n_mm */
                                   0.004, /* damping_max_n_s_mm */
                                   75.0, /* workspace_radius_mm */
                                   0.2,  /* handle_mass_kg */
                                   3,    /* degrees_of_freedom */
                                   open_device,
                                   read_device,
                                   write_device,
                                   free};

REAM_PLUGIN_EXPORT const ream_plugin_description ream_plugin = {
    REAM_PLUGIN_ABI, sizeof(ream_plugin_description), "steady-hand", "1.0", NULL, NULL, &device};
