#include "report/counters_json.hpp"

namespace host {

nlohmann::ordered_json counters_json(const urad_counters& c) {
  return {{"pairs", counted_pairs(c)},
          {"evaluated", c.evaluated},
          {"skipped_same", c.skipped_same},
          {"skipped_facing", c.skipped_facing},
          {"clipped", c.clipped},
          {"far_pairs", c.far_pairs},
          {"near_pairs", c.near_pairs},
          {"near_sums", c.sums},
          {"poses", c.poses},
          {"blocked", c.blocked},
          {"rays", c.rays},
          {"ray_tests", c.ray_tests},
          {"hemicube_faces", c.faces},
          {"hemicube_faces_empty", c.faces_empty},
          {"hemicube_cells", c.cells},
          {"hemicube_rows", c.rows},
          {"hemicube_rows_empty", c.rows_empty},
          {"skipped_behind", c.skipped_behind},
          {"skipped_small", c.skipped_small},
          {"skipped_convex", c.skipped_convex},
          {"networks", c.networks},
          {"rays_spared", c.rays_spared},
          {"blockers_kept", c.blockers_kept},
          {"blockers_rejected", c.blockers_rejected},
          {"shut_unseen", c.shut_unseen},
          {"tests_unseen", c.tests_unseen},
          {"sights", c.sights}};
}

}  // namespace host
