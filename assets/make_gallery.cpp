// Writes gallery.glb: the built-in scene as Blender would export it.
#include <cstdio>

#include "core/base/error.h"
#include "core/io/file.h"
#include "core/io/scene_gltf.h"
#include "core/scene/builders.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: make_gallery OUT.glb\n", stderr);
        return 2;
    }
    try {
        fluxwalk::io::writeFile(argv[1], fluxwalk::io::packSceneGltf(fluxwalk::scene::buildGallery()));
    } catch (const fluxwalk::base::FileError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
