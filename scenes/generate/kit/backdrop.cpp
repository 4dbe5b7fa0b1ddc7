// SPDX-License-Identifier: MIT
#include "backdrop.h"

#include "shapes.h"
#include "still_life.h"

namespace lodestir::generate {

void addTable(Glb& glb, const TableTop& table) {
    Model model{"table", {}};
    Mesh top = placed(roundedBox(table.size, table.edge, 3), table.centre);
    scaleUv(top, table.grain / panelSize);
    model.add(glb.addMaterial(glb.dressed({.name = table.material}, paintPanel(table.wood, table.seed, 1024))), top);
    glb.addNode(model);
}

void addWall(Glb& glb, const Material& paint, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down) {
    Model wall{"wall", {}};
    wall.add(glb.addMaterial(paint), rectangle(corner, right, down));
    glb.addNode(wall);
}

void addLamp(Glb& glb, const glm::vec3& centre, float radius, const glm::vec3& radiance) {
    const glm::vec3 away = radius * glm::vec3(1.6f, 2.6f, 1.1f);
    Model lamp{"lamp", {}};
    lamp.add(glb.addMaterial(glow("lamp", radiance)), panel(centre + away, -away, radius * glm::vec2(1.5f)));
    glb.addNode(lamp);
}

}  // namespace lodestir::generate
