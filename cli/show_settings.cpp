// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/show_settings.h>

#include <algorithm>
#include <iterator>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::cli {
namespace {

/// The position of "selection=1,2,3", whose words are separated by commas like those around it.
glm::dvec3 read_selection(const Values& values, std::string_view text) {
    constexpr settings::Setting kPosition{
        .name = "selection", .type = settings::Type::Vector, .range = settings::kPositions};
    const auto position = settings::value_from_text(kPosition, text);
    if (!position) {
        refuse_because(values, "show", position.error().in("selection needs three numbers"));
    }
    const auto v = position->get<std::array<double, 3>>();
    return {v[0], v[1], v[2]};
}

/// Removes and returns the text before the `count`th comma.
std::string_view take(std::string_view& text, int count) {
    size_t end = text.find(',');
    for (int i = 1; i < count && end != text.npos; ++i) end = text.find(',', end + 1);
    const std::string_view taken = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    return taken;
}

struct NamedView {
    std::string_view name;
    SurfaceView view;
};

constexpr NamedView kViews[] = {{"received", SurfaceView::Received},
                                {"direct", SurfaceView::Direct},
                                {"bounce", SurfaceView::Bounce},
                                {"emission", SurfaceView::Emission},
                                {"albedo", SurfaceView::Albedo},
                                {"normal", SurfaceView::Normal},
                                {"unwrapped-uv", SurfaceView::UnwrappedUv},
                                {"lightmap-uv", SurfaceView::LightmapUv},
                                {"texels", SurfaceView::Texels},
                                {"validity", SurfaceView::Validity},
                                {"pages", SurfaceView::Pages},
                                {"shadow-mask", SurfaceView::ShadowMask},
                                {"ambient-occlusion", SurfaceView::AmbientOcclusion}};

struct NamedGizmo {
    std::string_view name;
    bool GizmoSettings::*member;
};

constexpr NamedGizmo kGizmos[] = {{"probes", &GizmoSettings::has_probes},
                                  {"cells", &GizmoSettings::has_cells},
                                  {"lppv", &GizmoSettings::has_proxies},
                                  {"openings", &GizmoSettings::has_openings},
                                  {"seams", &GizmoSettings::has_seams}};

[[noreturn]] void refuse_word(const Values& values, std::string_view word) {
    std::string known;
    for (const NamedGizmo& gizmo : kGizmos) known += str_cat(gizmo.name, ", ");
    for (const NamedView& view : kViews) known += str_cat(view.name, ", ");
    refuse(values, "show", str_cat("\"", word, "\" is none of ", known, "selection=x,y,z"));
}

/// Reads one word of `show`.
void add_word(const Values& values, std::string_view word, ShowSettings& shown) {
    const auto gizmo = std::ranges::find(kGizmos, word, &NamedGizmo::name);
    const auto view = std::ranges::find(kViews, word, &NamedView::name);
    if (gizmo == std::end(kGizmos) && view == std::end(kViews)) refuse_word(values, word);
    const bool needs = word == "seams" || (view != std::end(kViews) && needs_lightmaps(view->view));
    if (needs && !values.is_given("lightmaps"))
        refuse(values, "show", str_cat("\"", word, "\" needs --lightmaps"));
    if (gizmo != std::end(kGizmos)) {
        shown.gizmos.*gizmo->member = true;
        return;
    }
    if (shown.view != SurfaceView::Shaded && shown.view != view->view) {
        const auto other = std::ranges::find(kViews, shown.view, &NamedView::view);
        refuse(values, "show",
               str_cat("surfaces cannot show \"", other->name, "\" and \"", word, "\" at once"));
    }
    shown.view = view->view;
}

}  // namespace

ShowSettings show_settings(const Values& values) {
    constexpr std::string_view kSelection = "selection=";
    ShowSettings shown;
    shown.gizmos.ball_radius = values.number32("ball_radius");
    shown.gizmos.probe_color = choice<ProbeColor>(values, "probe_color");
    const std::string text = values.text("show");
    for (std::string_view rest = text; !rest.empty() || text.ends_with(',');) {
        if (rest.starts_with(kSelection)) {
            shown.gizmos.selection =
                read_selection(values, take(rest, 3).substr(kSelection.size()));
        } else {
            add_word(values, take(rest, 1), shown);
        }
    }
    return shown;
}

}  // namespace tetralight::cli
