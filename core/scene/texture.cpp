#include "core/scene/texture.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/base/photometry.h"

namespace fluxwalk::scene {

namespace {

using base::Vec2d;
using base::Vec4;

/// Samples along each direction of a region: the finest picture that one element's mean can tell apart.
constexpr double kSamplesPerSide = 4.0;
/// Longest side of the grid of samples where a region is stretched in the texture.
constexpr double kMaxSamplesAlong = 16.0;

const std::array<float, 256>& linearOfByte() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            t[i] = static_cast<float>(base::linearFromSrgb(static_cast<double>(i) / 255.0));
        }
        return t;
    }();
    return table;
}

// KHR_texture_transform: scale, then turn counter-clockwise as seen with v downwards, then shift.
Vec2d transform(const TextureRef& texture, const Vec2d& texcoord) {
    Vec2d uv = Vec2d(texture.scale) * texcoord;
    if (texture.rotation != 0.0f) {
        const double c = std::cos(static_cast<double>(texture.rotation));
        const double s = std::sin(static_cast<double>(texture.rotation));
        uv = {c * uv.x + s * uv.y, c * uv.y - s * uv.x};
    }
    return uv + Vec2d(texture.offset);
}

double wrapCoordinate(Wrap wrap, double x) {
    switch (wrap) {
        case Wrap::repeat:
            return x - std::floor(x);
        case Wrap::mirror: {
            const double period = x - 2.0 * std::floor(0.5 * x);
            return period <= 1.0 ? period : 2.0 - period;
        }
        case Wrap::clamp:
            break;
    }
    return std::clamp(x, 0.0, 1.0);
}

/// Two neighbouring texels and the weight of the second.
struct Taps {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    float weight = 0.0f;
};

Taps tapsAt(Wrap wrap, double coordinate, std::uint32_t size) {
    const double x = wrapCoordinate(wrap, coordinate) * size - 0.5;
    const double low = std::floor(x);
    const auto last = static_cast<std::int64_t>(size) - 1;
    const auto wrapIndex = [&](std::int64_t i) {
        if (wrap == Wrap::repeat) {
            return static_cast<std::uint32_t>(i < 0 ? last : (i > last ? 0 : i));
        }
        return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, last));
    };
    const auto i = static_cast<std::int64_t>(low);
    return {wrapIndex(i), wrapIndex(i + 1), static_cast<float>(x - low)};
}

/// Source range of one texel of a level half as large: whole texels with partial weights at its ends.
struct Span {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    double from = 0.0;
    double to = 0.0;

    Span(std::uint32_t i, std::uint32_t coarse, std::uint32_t fine)
        : from(static_cast<double>(i) * fine / coarse), to(static_cast<double>(i + 1) * fine / coarse) {
        begin = static_cast<std::uint32_t>(from);
        end = std::min(fine, static_cast<std::uint32_t>(std::ceil(to)));
    }
    double weight(std::uint32_t j) const {
        return std::min(to, static_cast<double>(j) + 1.0) - std::max(from, static_cast<double>(j));
    }
};

}  // namespace

Vec4 TextureSet::Level::at(std::uint32_t x, std::uint32_t y) const {
    const std::size_t i = static_cast<std::size_t>(y) * width + x;
    if (!texels.empty()) {
        return texels[i];
    }
    const auto& linear = linearOfByte();
    const std::uint8_t* p = bytes.data() + 4 * i;
    return {linear[p[0]], linear[p[1]], linear[p[2]], static_cast<float>(p[3]) * (1.0f / 255.0f)};
}

Vec4 TextureSet::Level::numbersAt(std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* p = bytes.data() + 4 * (static_cast<std::size_t>(y) * width + x);
    return Vec4(p[0], p[1], p[2], p[3]) * (1.0f / 255.0f);
}

TextureSet::Level TextureSet::halve(const Level& fine) {
    Level coarse;
    coarse.width = std::max(1u, fine.width / 2);
    coarse.height = std::max(1u, fine.height / 2);
    coarse.texels.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
    for (std::uint32_t y = 0; y < coarse.height; ++y) {
        const Span rows(y, coarse.height, fine.height);
        for (std::uint32_t x = 0; x < coarse.width; ++x) {
            const Span columns(x, coarse.width, fine.width);
            glm::dvec4 sum(0.0);
            for (std::uint32_t j = rows.begin; j < rows.end; ++j) {
                for (std::uint32_t i = columns.begin; i < columns.end; ++i) {
                    sum += rows.weight(j) * columns.weight(i) * glm::dvec4(fine.at(i, j));
                }
            }
            coarse.texels.emplace_back(sum / ((rows.to - rows.from) * (columns.to - columns.from)));
        }
    }
    return coarse;
}

TextureSet::TextureSet(const Scene& scene) {
    images_.reserve(scene.images.size());
    for (const Image& image : scene.images) {
        FLUXWALK_CHECK_LT(0u, image.width);
        FLUXWALK_CHECK_LT(0u, image.height);
        FLUXWALK_CHECK_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
        std::vector<Level>& levels = images_.emplace_back();
        levels.push_back({image.width, image.height, {}, image.rgba});
        while (levels.back().width > 1 || levels.back().height > 1) {
            levels.push_back(halve(levels.back()));
        }
    }
}

Vec4 TextureSet::bilinear(const Level& level, const TextureRef& texture, const Vec2d& uv) {
    const Taps x = tapsAt(texture.wrapU, uv.x, level.width);
    const Taps y = tapsAt(texture.wrapV, uv.y, level.height);
    const Vec4 top = (1.0f - x.weight) * level.at(x.first, y.first) + x.weight * level.at(x.second, y.first);
    const Vec4 bottom =
        (1.0f - x.weight) * level.at(x.first, y.second) + x.weight * level.at(x.second, y.second);
    return (1.0f - y.weight) * top + y.weight * bottom;
}

Vec4 TextureSet::sampleNumbers(const TextureRef& texture, const Vec2d& texcoord) const {
    const Level& level = images_[static_cast<std::size_t>(texture.image)].front();
    const Vec2d uv = transform(texture, texcoord);
    const Taps x = tapsAt(texture.wrapU, uv.x, level.width);
    const Taps y = tapsAt(texture.wrapV, uv.y, level.height);
    const Vec4 top =
        glm::mix(level.numbersAt(x.first, y.first), level.numbersAt(x.second, y.first), x.weight);
    const Vec4 bottom =
        glm::mix(level.numbersAt(x.first, y.second), level.numbersAt(x.second, y.second), x.weight);
    return glm::mix(top, bottom, y.weight);
}

Vec4 TextureSet::sample(const TextureRef& texture, const Vec2d& texcoord, float level) const {
    if (!texture.isSet()) {
        return Vec4(1.0f);
    }
    const std::vector<Level>& levels = images_[static_cast<std::size_t>(texture.image)];
    const Vec2d uv = transform(texture, texcoord);
    const float clamped = std::clamp(level, 0.0f, static_cast<float>(levels.size() - 1));
    const float fine = std::floor(clamped);
    const auto i = static_cast<std::size_t>(fine);
    const Vec4 first = bilinear(levels[i], texture, uv);
    const float between = clamped - fine;
    return between > 0.0f ? (1.0f - between) * first + between * bilinear(levels[i + 1], texture, uv) : first;
}

float TextureSet::levelFor(const TextureRef& texture, double footprint) const {
    if (!texture.isSet()) {
        return 0.0f;
    }
    const std::vector<Level>& levels = images_[static_cast<std::size_t>(texture.image)];
    // The wider side of a texel decides, so that a sample never reaches beyond the footprint.
    const double texels =
        footprint * std::min(levels[0].width * std::abs(static_cast<double>(texture.scale.x)),
                             levels[0].height * std::abs(static_cast<double>(texture.scale.y)));
    if (!(texels > 1.0)) {
        return 0.0f;
    }
    return std::min(static_cast<float>(std::log2(texels)), static_cast<float>(levels.size() - 1));
}

float coverageAt(const Material& material, const TextureSet& textures, const Vec2d& texcoord) {
    if (material.alphaMode == AlphaMode::opaque) {
        return 1.0f;
    }
    const float alpha = material.alpha * textures.sample(material.reflectanceTexture, texcoord).a;
    if (material.alphaMode == AlphaMode::mask) {
        return alpha >= material.alphaCutoff ? 1.0f : 0.0f;
    }
    return std::clamp(alpha, 0.0f, 1.0f);
}

namespace {

/// Pyramid levels at which the textures of a material are sampled.
struct Levels {
    float reflectance = 0.0f;
    float emission = 0.0f;
};

RegionMaterial materialAt(const TextureSet& textures, const Object& object, const Material& material,
                          std::uint32_t patch, const Vec2d& uv, const Levels& levels) {
    const TextureRef& reflectance = material.reflectanceTexture;
    const Vec2d texcoord = object.surface->texcoord(patch, uv, reflectance.texcoordSet);
    const float coverage = coverageAt(material, textures, texcoord);
    if (coverage == 0.0f) {
        return {};
    }
    RegionMaterial result{material.reflectance, material.emission};
    result.reflectance *= Rgb(textures.sample(reflectance, texcoord, levels.reflectance));
    if (material.emissionTexture.isSet()) {
        const unsigned set = material.emissionTexture.texcoordSet;
        result.emission *= Rgb(textures.sample(material.emissionTexture,
                                               object.surface->texcoord(patch, uv, set), levels.emission));
    }
    result.reflectance = coverage * glm::min(result.reflectance, Rgb(kMaxReflectance));
    result.emission *= coverage;
    return result;
}

/// Grid of samples over a region, its cells about square in the texture.
struct Grid {
    unsigned alongS = 1;
    unsigned alongT = 1;
    double cell = 0.0;  ///< longer side of a cell, in texture coordinates
};

Grid gridFor(const Object& object, std::uint32_t patch, const surface::Region& region, unsigned set) {
    std::array<Vec2d, 4> c{};
    for (std::uint32_t i = 0; i < region.cornerCount; ++i) {
        c[i] = object.surface->texcoord(patch, region.corners[i], set);
    }
    double s = 0.0;
    double t = 0.0;
    if (region.cornerCount == 3) {
        s = std::max(glm::distance(c[0], c[1]), glm::distance(c[0], c[2]));
        t = glm::distance(c[1], c[2]);
    } else {
        s = std::max(glm::distance(c[0], c[1]), glm::distance(c[3], c[2]));
        t = std::max(glm::distance(c[0], c[3]), glm::distance(c[1], c[2]));
    }
    Grid grid;
    const double side = std::sqrt(s * t) / kSamplesPerSide;
    const auto countAlong = [side](double length) {
        return static_cast<unsigned>(
            std::clamp(side > 0.0 ? std::round(length / side) : kSamplesPerSide, 1.0, kMaxSamplesAlong));
    };
    grid.alongS = countAlong(s);
    grid.alongT = countAlong(t);
    grid.cell = std::max(s / grid.alongS, t / grid.alongT);
    return grid;
}

}  // namespace

RegionMaterial regionMaterial(const Scene& scene, const TextureSet& textures, const Object& object,
                              std::uint32_t patch, const surface::Region& region) {
    const Material& material = scene.materials[object.material];
    if (!material.reflectanceTexture.isSet() && !material.emissionTexture.isSet()) {
        const float coverage = coverageAt(material, textures, Vec2d(0.0));
        return {coverage * glm::min(material.reflectance, Rgb(kMaxReflectance)),
                coverage * material.emission};
    }
    const TextureRef& leading =
        material.reflectanceTexture.isSet() ? material.reflectanceTexture : material.emissionTexture;
    const Grid grid = gridFor(object, patch, region, leading.texcoordSet);
    // Texels half a cell wide: bilinear samples at the cells' middles then read nothing outside the region.
    const Levels levels{std::floor(textures.levelFor(material.reflectanceTexture, 0.5 * grid.cell)),
                        std::floor(textures.levelFor(material.emissionTexture, 0.5 * grid.cell))};
    base::Vec3d reflectance(0.0);
    base::Vec3d emission(0.0);
    double area = 0.0;
    for (unsigned i = 0; i < grid.alongS; ++i) {
        for (unsigned j = 0; j < grid.alongT; ++j) {
            const surface::RegionPoint at =
                surface::mapToRegion(region, {(i + 0.5) / grid.alongS, (j + 0.5) / grid.alongT});
            const double weight = at.jacobian * object.surface->evaluate(patch, at.uv).jacobian;
            const RegionMaterial here = materialAt(textures, object, material, patch, at.uv, levels);
            reflectance += weight * base::Vec3d(here.reflectance);
            emission += weight * base::Vec3d(here.emission);
            area += weight;
        }
    }
    if (!(area > 0.0)) {
        return {};
    }
    return {Rgb(reflectance / area), Rgb(emission / area)};
}

RegionMaterial pointMaterial(const Scene& scene, const TextureSet& textures, const Object& object,
                             std::uint32_t patch, const base::Vec2d& uv) {
    return materialAt(textures, object, scene.materials[object.material], patch, uv, Levels{});
}

}  // namespace fluxwalk::scene
