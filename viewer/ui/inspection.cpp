#include "viewer/ui/inspection.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "core/base/photometry.h"
#include "viewer/render/camera.h"
#include "viewer/ui/format.h"
#include "viewer/ui/theme.h"

namespace fluxwalk::ui {
namespace {

using hierarchy::NodeKind;

/// Lines that are drawn at most, and the least part of the light that one must carry.
constexpr std::size_t kMostLinks = 300;
constexpr float kLeastPart = 1e-3f;
/// Lines of the list at most, and the part of the picture's height that they may take.
constexpr std::size_t kMostContributors = 12;
constexpr float kMostOfHeight = 0.4f;
constexpr std::size_t kMostPrinted = 20;
constexpr float kMargin = 14.0f;
constexpr float kPadding = 10.0f;
constexpr float kColumnGap = 16.0f;
/// Readouts of points beyond this part of the picture's width are to their left.
constexpr float kLeftOf = 0.6f;

std::string nameOr(const std::string& name, const char* kind, std::uint32_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

std::string nameOf(const image::Contributor& c, const scene::Scene& scene) {
    switch (c.kind) {
        case NodeKind::light:
            return nameOr(scene.lights[c.index].name, "light", c.index);
        case NodeKind::sky:
            return "sky";
        default:
            return nameOr(scene.objects[c.index].name, "object", c.index);
    }
}

std::string objectName(const image::Inspection& i, const scene::Scene& scene) {
    return nameOr(scene.objects[i.object].name, "object", i.object) + (i.back ? " (back)" : "");
}

std::string materialName(const image::Inspection& i, const scene::Scene& scene) {
    const std::uint32_t material = scene.objects[i.object].material;
    return nameOr(scene.materials[material].name, "material", material);
}

/// An area in the unit that suits it.
std::string formatArea(double area) {
    return area < 1e-4   ? formatValue(area * 1e6) + " mm\u00b2"
           : area < 0.01 ? formatValue(area * 1e4) + " cm\u00b2"
                         : formatValue(area) + " m\u00b2";
}

double value(const base::Rgb& color) {
    return static_cast<double>(base::luminance(color));
}

/// From the world to pixels of the present picture.
class Projection {
  public:
    explicit Projection(const scene::Camera& camera) : size_(ImGui::GetIO().DisplaySize) {
        const double distance = 1e-3;
        matrix_ = render::clipFromWorld(camera, static_cast<double>(size_.x / size_.y), {distance, 1e6});
        nearest_ = static_cast<float>(distance);
    }

    std::optional<ImVec2> operator()(const base::Vec3& point) const {
        const glm::vec4 clip = matrix_ * glm::vec4(point, 1.0f);
        return clip.w > nearest_ ? std::optional(pixelOf(clip)) : std::nullopt;
    }
    /// A line, its part behind the eye cut off.
    void line(ImDrawList& list, const base::Vec3& from, const base::Vec3& to, ImU32 color,
              float thickness) const {
        glm::vec4 a = matrix_ * glm::vec4(from, 1.0f);
        glm::vec4 b = matrix_ * glm::vec4(to, 1.0f);
        if (a.w < nearest_ && b.w < nearest_) {
            return;
        }
        if (a.w < nearest_ || b.w < nearest_) {
            const glm::vec4 cut = glm::mix(a, b, (nearest_ - a.w) / (b.w - a.w));
            (a.w < nearest_ ? a : b) = cut;
        }
        list.AddLine(pixelOf(a), pixelOf(b), color, thickness);
    }

  private:
    ImVec2 pixelOf(const glm::vec4& clip) const {
        return {(0.5f + 0.5f * clip.x / clip.w) * size_.x, (0.5f - 0.5f * clip.y / clip.w) * size_.y};
    }

    ImVec2 size_;
    glm::mat4 matrix_{1.0f};
    float nearest_ = 0.0f;
};

ImVec4 colorOf(NodeKind kind) {
    return kind == NodeKind::element ? kAccent : kind == NodeKind::cluster ? kCool : ImVec4(1, 1, 0.85f, 1);
}

// All links alike, since a blocked one brings no light; the most blocked last, on top.
void drawVisibility(ImDrawList& list, const image::Inspection& inspection, const Projection& project,
                    float scale) {
    const render::ColorMap map;
    std::vector<image::Connection> links = inspection.connections;
    std::stable_sort(links.begin(), links.end(), [](const image::Connection& a, const image::Connection& b) {
        return a.visibility > b.visibility;
    });
    for (const image::Connection& link : links) {
        const render::Color8& c = map.at(static_cast<double>(link.visibility));
        project.line(list, inspection.center, link.source, IM_COL32(c[0], c[1], c[2], 170), 1.2f * scale);
    }
}

void drawLinks(ImDrawList& list, const image::Inspection& inspection, const Projection& project,
               float scale) {
    const double total = std::max(value(inspection.irradiance), 1e-12);
    const std::size_t count = std::min(kMostLinks, inspection.connections.size());
    // The strongest last, on top.
    for (std::size_t k = count; k-- > 0;) {
        const image::Connection& link = inspection.connections[k];
        const auto part = static_cast<float>(std::min(1.0, value(link.irradiance) / total));
        if (part < kLeastPart) {
            continue;
        }
        ImVec4 color = colorOf(link.kind);
        color.w = std::min(1.3f * std::sqrt(part), 0.9f);
        project.line(list, inspection.center, link.source, ImGui::GetColorU32(color),
                     scale * (0.8f + 7.0f * std::sqrt(part)));
    }
}

/// One line of a field of text.
struct Line {
    std::string left;
    std::string right;
    bool isDim = false;
    float part = 0.0f;  ///< length of a bar behind the line
};

float lineHeight() {
    return 1.2f * ImGui::GetFontSize();
}

/// Lines of text on a dark field.
class TextField {
  public:
    TextField(std::vector<Line> lines, const Canvas& canvas)
        : lines_(std::move(lines)),
          scale_(canvas.scale),
          reserved_(canvas.reserved),
          left_(canvas.left),
          padding_(kPadding * canvas.scale) {
        float left = 0.0f;
        float right = 0.0f;
        for (const Line& line : lines_) {
            left = std::max(left, ImGui::CalcTextSize(line.left.c_str()).x);
            right = std::max(right, ImGui::CalcTextSize(line.right.c_str()).x);
        }
        inner_ = left + (right > 0.0f ? kColumnGap * scale_ + right : 0.0f);
        size_ = ImVec2(inner_ + 2.0f * padding_,
                       lineHeight() * static_cast<float>(lines_.size()) + 2.0f * padding_);
    }

    const ImVec2& size() const { return size_; }

    /// Puts its upper left corner there, or as near as the picture allows.
    void moveTo(ImVec2 place) {
        const ImVec2 display = ImGui::GetIO().DisplaySize;
        const float margin = 4.0f * scale_;
        lower_ = ImVec2(
            std::clamp(place.x, left_ + margin, std::max(left_ + margin, display.x - size_.x - margin)),
            std::clamp(place.y, margin, std::max(margin, display.y - reserved_ - size_.y - margin)));
    }
    void draw(ImDrawList& list) const {
        list.AddRectFilled(lower_, ImVec2(lower_.x + size_.x, lower_.y + size_.y),
                           ImGui::GetColorU32(ImGuiCol_WindowBg, 0.96f), 6.0f * scale_);
        ImVec2 at(lower_.x + padding_, lower_.y + padding_);
        for (const Line& line : lines_) {
            drawLine(list, line, at);
            at.y += lineHeight();
        }
    }

  private:
    void drawLine(ImDrawList& list, const Line& line, const ImVec2& at) const {
        if (line.part > 0.0f) {
            ImVec4 bar = kAccent;
            bar.w = 0.28f;
            const float left = at.x - 0.4f * padding_;
            list.AddRectFilled(
                ImVec2(left, at.y - 0.05f * lineHeight()),
                ImVec2(left + line.part * (inner_ + 0.8f * padding_), at.y + 0.9f * lineHeight()),
                ImGui::GetColorU32(bar), 2.0f * scale_);
        }
        const ImU32 color = line.isDim ? ImGui::GetColorU32(kTextDim) : ImGui::GetColorU32(ImGuiCol_Text);
        list.AddText(at, color, line.left.c_str());
        const float width = ImGui::CalcTextSize(line.right.c_str()).x;
        list.AddText(ImVec2(at.x + inner_ - width, at.y), color, line.right.c_str());
    }

    std::vector<Line> lines_;
    float scale_;
    float reserved_;
    float left_;
    float padding_;
    float inner_ = 0.0f;
    ImVec2 size_;
    ImVec2 lower_;
};

std::vector<Line> readout(const image::Inspection& i, const scene::Scene& scene) {
    const base::Rgb& e = i.irradiance;
    return {{formatValue(value(e)) + " lx", formatValue(value(i.luminance)) + " cd/m\u00b2"},
            {"red, green, blue",
             fmt::format("{}  {}  {} lx", formatValue(static_cast<double>(e.r)),
                         formatValue(static_cast<double>(e.g)), formatValue(static_cast<double>(e.b))),
             true},
            {objectName(i, scene), materialName(i, scene), true},
            {fmt::format("element of level {}, {}", i.level, formatArea(i.area)),
             fmt::format("{} links", i.connections.size()), true}};
}

std::vector<Line> listContributors(const image::Inspection& inspection, const scene::Scene& scene) {
    const double total = std::max(value(inspection.irradiance), 1e-12);
    std::vector<Line> lines{{"What lights this point", formatValue(value(inspection.irradiance)) + " lx"}};
    const auto part = [&](double lux) { return static_cast<float>(std::clamp(lux / total, 0.0, 1.0)); };
    double rest = 0.0;
    const float room = kMostOfHeight * ImGui::GetIO().DisplaySize.y / lineHeight() - 2.0f;
    const std::size_t most = std::min(kMostContributors, static_cast<std::size_t>(std::max(room, 3.0f)));
    for (std::size_t k = 0; k < inspection.contributors.size(); ++k) {
        const image::Contributor& c = inspection.contributors[k];
        const double lux = value(c.irradiance);
        if (k < most) {
            lines.push_back({nameOf(c, scene), formatPercent(lux / total), false, part(lux)});
        } else {
            rest += lux;
        }
    }
    if (inspection.contributors.size() > most) {
        lines.push_back({fmt::format("{} others", inspection.contributors.size() - most),
                         formatPercent(rest / total), true, part(rest)});
    }
    return lines;
}

}  // namespace

std::string describeInspection(const image::Inspection& i, const scene::Scene& scene) {
    const base::Vec3d& p = i.point.position;
    const base::Vec3d& n = i.point.normal;
    std::string text =
        fmt::format("point: {:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", p.x, p.y, p.z, n.x, n.y, n.z);
    text +=
        fmt::format("irradiance: {:.9g},{:.9g},{:.9g} lx\n", i.irradiance.r, i.irradiance.g, i.irradiance.b);
    text += fmt::format("illuminance: {:.6g} lx\n", value(i.irradiance));
    text += fmt::format("luminance: {:.6g} cd/m\u00b2\n", value(i.luminance));
    text += "object: " + objectName(i, scene) + "\n";
    text += "material: " + materialName(i, scene) + "\n";
    text +=
        fmt::format("element: level {}, {:.6g} m\u00b2, {} links\n", i.level, i.area, i.connections.size());
    const double total = std::max(value(i.irradiance), 1e-12);
    for (std::size_t k = 0; k < std::min(kMostPrinted, i.contributors.size()); ++k) {
        const image::Contributor& c = i.contributors[k];
        const double lux = value(c.irradiance);
        text += fmt::format("lit by: {:.2f} %, {:.6g} lx, {}\n", 100.0 * lux / total, lux, nameOf(c, scene));
    }
    return text;
}

void drawInspection(const image::Inspection& inspection, const scene::Scene& scene,
                    const scene::Camera& camera, const InspectionView& view, const Canvas& canvas) {
    const float scale = canvas.scale;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const Projection project(camera);
    if (view.visibility) {
        drawVisibility(list, inspection, project, scale);
    } else if (view.links) {
        drawLinks(list, inspection, project, scale);
    }
    // Dark below bright, so that it is seen on surfaces of any colour.
    for (const auto& [color, thickness] :
         {std::pair(IM_COL32(0, 0, 0, 160), 3.5f), std::pair(ImGui::GetColorU32(kAccent), 1.5f)}) {
        for (std::size_t k = 0; k < inspection.outline.size(); ++k) {
            project.line(list, inspection.outline[k], inspection.outline[(k + 1) % inspection.outline.size()],
                         color, thickness * scale);
        }
    }
    const float width = ImGui::GetIO().DisplaySize.x;
    if (view.contributors) {
        TextField contributors(listContributors(inspection, scene), canvas);
        const float margin = kMargin * scale;
        contributors.moveTo(ImVec2(width - contributors.size().x - margin, margin));
        contributors.draw(list);
    }
    if (const auto place = project(base::Vec3(inspection.point.position))) {
        list.AddCircle(*place, 4.0f * scale, IM_COL32_BLACK, 0, 3.0f * scale);
        list.AddCircle(*place, 4.0f * scale, IM_COL32_WHITE, 0, 1.5f * scale);
        TextField values(readout(inspection, scene), canvas);
        const float away = 14.0f * scale;
        // Towards the middle: lists and legends are at the right edge.
        const bool isLeft = place->x > kLeftOf * width;
        values.moveTo(ImVec2(isLeft ? place->x - away - values.size().x : place->x + away, place->y + away));
        values.draw(list);
    }
}

}  // namespace fluxwalk::ui
