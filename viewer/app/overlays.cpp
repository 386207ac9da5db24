#include "viewer/app/overlays.h"

#include <algorithm>

namespace fluxwalk::app {
namespace {

using render::Color8;
using render::Shown;

/// Colours of elements by a value of each, with the legend's title and numbers filled in.
class ElementColors {
  public:
    ElementColors(const solve::Snapshot& snapshot, Shown shown, const render::ColorMap& map)
        : shown_(shown), map_(map) {
        if (shown == Shown::level) {
            prepareLevels(snapshot);
        } else {
            prepareValues(snapshot);
        }
    }

    Color8 operator()(const solve::MeshElements& elements, std::size_t element) const {
        if (shown_ == Shown::level) {
            return legend_.colors[elements.level[element]];
        }
        return map_.at(render::placeOf(static_cast<double>(valuesOf(elements, shown_)[element]), range_,
                                       render::ValueScale::logarithmic));
    }
    /// Of each element; empty where the snapshot does not tell.
    static const std::vector<float>& valuesOf(const solve::MeshElements& elements, Shown shown) {
        return shown == Shown::linkErrors ? elements.error : elements.residual;
    }
    const ui::Legend& legend() const { return legend_; }

  private:
    void prepareLevels(const solve::Snapshot& snapshot) {
        std::size_t deepest = 0;
        for (const auto& elements : snapshot.elements) {
            for (const std::uint8_t level : elements->level) {
                deepest = std::max<std::size_t>(deepest, level);
            }
        }
        legend_.title = "Level of the elements";
        for (std::size_t i = 0; i <= deepest; ++i) {
            const double parts = std::max(1.0, static_cast<double>(deepest));
            legend_.colors.push_back(map_.at(static_cast<double>(i) / parts));
            const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(deepest + 1);
            legend_.marks.push_back({place, std::to_string(i), false});
        }
    }
    void prepareValues(const solve::Snapshot& snapshot) {
        render::LuminanceHistogram values;
        for (const auto& elements : snapshot.elements) {
            for (const float value : valuesOf(*elements, shown_)) {
                values.add(static_cast<double>(value), 1.0);
            }
        }
        range_ = render::chooseRange(values, render::ValueScale::logarithmic);
        legend_ = ui::makeLegend({{}, {}, shown_}, range_, map_);
    }

    Shown shown_;
    const render::ColorMap& map_;
    render::ValueRange range_;
    ui::Legend legend_;
};

Color8 colorOfObject(std::uint32_t object) {
    const base::Rgb color = render::colorOfNumber(object) * 255.0f + 0.5f;
    return {static_cast<std::uint8_t>(color.r), static_cast<std::uint8_t>(color.g),
            static_cast<std::uint8_t>(color.b)};
}

}  // namespace

solve::Detail detailFor(const render::DrawSettings& look) {
    solve::Detail detail;
    detail.elements = look.elementEdges || look.shown == Shown::level || look.shown == Shown::residual ||
                      look.shown == Shown::linkErrors;
    detail.errors = look.shown == Shown::linkErrors;
    detail.residuals = look.shown == Shown::residual;
    detail.clusters = look.clusterBoxes;
    return detail;
}

std::optional<ui::Legend> fillOverlay(render::Overlay& overlay, const solve::Snapshot& snapshot,
                                      const render::DrawSettings& look, const render::ColorMap& map) {
    const bool hasElements = snapshot.elements.size() == snapshot.meshes.size();
    const bool isValue = look.shown == Shown::residual || look.shown == Shown::linkErrors;
    const bool hasValues =
        isValue && hasElements &&
        std::any_of(snapshot.elements.begin(), snapshot.elements.end(), [&](const auto& elements) {
            return !ElementColors::valuesOf(*elements, look.shown).empty();
        });
    const bool colorsElements = hasElements && (look.shown == Shown::level || hasValues);
    std::optional<ElementColors> colors;
    if (colorsElements) {
        colors.emplace(snapshot, look.shown, map);
    }
    std::vector<render::FaceColors> faces;
    for (std::size_t i = 0; i < snapshot.meshes.size(); ++i) {
        const auto& mesh = snapshot.meshes[i];
        const std::size_t count = mesh->triangles.size() / 3;
        render::FaceColors face{mesh, {}, {}};
        if (look.shown == Shown::objects) {
            face.colors.assign(count, colorOfObject(mesh->object));
        } else if (colors) {
            const solve::MeshElements& elements = *snapshot.elements[i];
            for (const std::uint32_t element : elements.elementOf) {
                face.colors.push_back((*colors)(elements, element));
            }
        }
        if (look.elementEdges && hasElements) {
            face.edges = snapshot.elements[i]->edges;
        }
        faces.push_back(std::move(face));
    }
    overlay.setFaces(faces);
    std::vector<base::Box> boxes;
    if (look.clusterBoxes && snapshot.clusters) {
        for (const solve::ClusterBox& cluster : *snapshot.clusters) {
            if (cluster.depth == look.clusterDepth) {
                base::Box box;
                box.extend(base::Vec3d(cluster.lower));
                box.extend(base::Vec3d(cluster.upper));
                boxes.push_back(box);
            }
        }
    }
    overlay.setBoxes(boxes);
    return colors ? std::optional(colors->legend()) : std::nullopt;
}

void drawLegends(const ui::Canvas& canvas, const render::DrawSettings& look,
                 const std::optional<ui::Legend>& faces, bool hasVisibility, const render::ValueRange& range,
                 const render::ColorMap& map) {
    float width = 0.0f;
    if (faces) {
        width = ui::drawLegend(*faces, canvas);
    } else if (look.shown == Shown::illuminance || look.shown == Shown::luminance) {
        width = ui::drawLegend(ui::makeLegend(look, range, map), canvas);
    }
    if (hasVisibility) {
        ui::drawLegend(ui::makeVisibilityLegend(map), canvas, width);
    }
}

}  // namespace fluxwalk::app
