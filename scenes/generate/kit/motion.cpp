// SPDX-License-Identifier: MIT
#include "motion.h"

namespace lodestir::generate {

void animate(Glb& glb, int node, Motion motion, int pieces, const std::function<glm::vec4(float)>& at) {
    std::vector<float> seconds;
    std::vector<glm::vec4> values;
    for (int i = 0; i <= pieces; ++i) {
        seconds.push_back(float(i) / 24);
        values.push_back(at(float(i) / float(pieces)));
    }
    glb.animate(node, motion, seconds, values);
}

glm::vec4 asVector(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

}  // namespace lodestir::generate
