#include "core/rays/patch_tree.h"

#include "core/surface/region.h"

namespace fluxwalk::rays {

PatchTree::PatchTree(const scene::Scene& scene, TreeBuilder by, const base::Executor& executor)
    : builder(by) {
    for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
        firstItem.push_back(static_cast<std::uint32_t>(items.size()));
        for (std::uint32_t p = 0; p < scene.objects[o].surface->patchCount(); ++p) {
            items.push_back({o, p});
        }
    }
    boxes.resize(items.size());
    executor.forRange(items.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const surface::Surface& surface = *scene.objects[items[i].object].surface;
            boxes[i] =
                surface.bounds(items[i].patch, surface::wholePatch(surface.domain(items[i].patch))).box;
        }
    });
    tree = buildTree(builder, {boxes}, executor);
}

}  // namespace fluxwalk::rays
