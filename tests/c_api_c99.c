/* The C interface as a C99 program sees it; driven by c_api_test.cpp. */
#include "urad/urad.h"

/* The macro is a constant expression. */
extern uint32_t c99_cube_memory[];
uint32_t c99_cube_memory[URAD_RADIOSITY_BYTES(294, 49) / 4];

size_t c99_static_bytes(void);
urad_status c99_solve(const urad_scene* scene, const urad_source* source, uint32_t* memory,
                      size_t bytes, uint32_t error_uq32, int32_t* exitance, int* balanced);

size_t c99_static_bytes(void) { return sizeof c99_cube_memory; }

urad_status c99_solve(const urad_scene* scene, const urad_source* source, uint32_t* memory,
                      size_t bytes, uint32_t error_uq32, int32_t* exitance, int* balanced) {
  urad_radiosity state;
  urad_status status = urad_radiosity_init(&state, scene, source, URAD_OVERSHOOT,
                                           urad_longest_run(scene), memory, bytes);
  while (status == URAD_OK && !urad_radiosity_done(&state, error_uq32))
    status = urad_radiosity_step(&state);
  if (status != URAD_OK) return status;
  for (uint16_t patch = 0; patch < scene->patch_count; ++patch) {
    for (unsigned channel = 0; channel < 3; ++channel) {
      status = urad_radiosity_get(&state, patch, channel, &exitance[3 * patch + channel]);
      if (status != URAD_OK) return status;
    }
  }
  *balanced = urad_radiosity_audit(&state, NULL);
  return URAD_OK;
}
