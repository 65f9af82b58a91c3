// SPDX-License-Identifier: Apache-2.0
// Positions and coefficients in Unity's axes, as flat arrays that its JsonUtility reads, and a
// script for its editor that makes a Light Probe Group of them and replaces the light of a bake.
// Unity has x mirrored; SphericalHarmonicsL2[channel, i] is a factor of the polynomial i of
// irradiance ÷ π.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/targets.h>
#include <tetralight/engines/detail/xyz_text.h>
#include <tetralight/engines/escape.h>

namespace tetralight::detail {
namespace {

/// Factors of 1, y, z, x, xy, yz, 3z² − 1, xz, x² − y² in the basis; those of polynomials that are
/// odd in x are negative.
constexpr std::array<float, kShCoefficientCount> kMirroredBasis{
    0.2820948f, 0.4886025f, 0.4886025f,  -0.4886025f, -1.0925484f,
    1.0925484f, 0.3153916f, -1.0925484f, 0.5462742f};

/// Moves of probes by rounding that are worth a note, metres.
constexpr double kLargeMove = 1e-4;

/// A JSON array of `count` lines. `append(text, i)` writes the numbers of one.
template <class Append>
void append_lines(std::string& text, const char* name, size_t count, Append&& append) {
    text += str_cat(",\n  \"", name, "\": [");
    for (size_t i = 0; i < count; ++i) {
        text += i == 0 ? "\n    " : ",\n    ";
        append(text, i);
    }
    text += count == 0 ? "]" : "\n  ]";
}

glm::vec3 unity_position(const ProbeVolumeView& volume, uint32_t probe) {
    const glm::vec3 position(world_position(volume, probe));
    return {-position.x, position.y, position.z};
}

/// The coefficients of red, then those of green, then those of blue.
void append_coefficients(std::string& text, const IrradianceSh& light) {
    for (int channel = 0; channel < 3; ++channel) {
        for (size_t i = 0; i < kShCoefficientCount; ++i) {
            const float factor = kMirroredBasis[i] * std::numbers::inv_pi_v<float>;
            if (channel > 0 || i > 0) text += ", ";
            append_text(text, factor * light.coefficients[i][channel]);
        }
    }
}

std::string probes_json(const ProbeVolumeView& volume) {
    const auto light = probe_light(volume);
    std::string text =
        "{\n  \"format\": \"tetralight unity\",\n  \"version\": 1,\n"
        "  \"about\": \"left-handed, metres; coefficients[27 probe + 9 channel + i] is "
        "SphericalHarmonicsL2[channel, i]\"";
    append_lines(text, "positions", volume.positions.size(), [&](std::string& out, size_t i) {
        const glm::vec3 p = unity_position(volume, static_cast<uint32_t>(i));
        out += xyz_text(p);
    });
    append_lines(text, "coefficients", light.size(),
                 [&](std::string& out, size_t i) { append_coefficients(out, light[i]); });
    append_lines(text, "occlusion", volume.occlusion.size(), [&](std::string& out, size_t i) {
        const glm::vec4& o = volume.occlusion[i];
        out += str_cat(o.x, ", ", o.y, ", ", o.z, ", ", o.w);
    });
    return text + "\n}\n";
}

constexpr const char* kUnityScript =
    R"cs(// Copy this file into a folder named Editor of a Unity project, and the .json file beside it into
// its assets. Select the .json file, then choose Tools > Tetralight > Make Light Probe Group, bake
// the lighting of the scene, and choose Tools > Tetralight > Write Light of Probes.
using System;
using System.Collections.Generic;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.SceneManagement;

public static class TetralightProbes
{
    const string GroupName = "Tetralight Probes";
    const string MakeMenu = "Tools/Tetralight/Make Light Probe Group";
    const string WriteMenu = "Tools/Tetralight/Write Light of Probes";
    const float Tolerance = 1e-3f;

    [Serializable]
    class ProbeFile
    {
        public string format;
        public int version;
        public float[] positions;
        public float[] coefficients;

        public int Count { get { return positions.Length / 3; } }

        public Vector3 Position(int probe)
        {
            int i = 3 * probe;
            return new Vector3(positions[i], positions[i + 1], positions[i + 2]);
        }

        public SphericalHarmonicsL2 Light(int probe)
        {
            var light = new SphericalHarmonicsL2();
            for (int channel = 0; channel < 3; ++channel)
                for (int i = 0; i < 9; ++i)
                    light[channel, i] = coefficients[27 * probe + 9 * channel + i];
            return light;
        }
    }

    [MenuItem(MakeMenu, true)]
    [MenuItem(WriteMenu, true)]
    static bool IsFileSelected()
    {
        return Selection.activeObject is TextAsset;
    }

    [MenuItem(MakeMenu)]
    static void MakeGroup()
    {
        ProbeFile file = ReadSelected();
        if (file == null) return;
        var positions = new Vector3[file.Count];
        for (int i = 0; i < positions.Length; ++i) positions[i] = file.Position(i);
        GameObject old = GameObject.Find(GroupName);
        if (old != null) Undo.DestroyObjectImmediate(old);
        var made = new GameObject(GroupName);
        Undo.RegisterCreatedObjectUndo(made, MakeMenu);
        made.AddComponent<LightProbeGroup>().probePositions = positions;
        EditorSceneManager.MarkSceneDirty(made.scene);
    }

    [MenuItem(WriteMenu)]
    static void WriteLight()
    {
        ProbeFile file = ReadSelected();
        if (file == null) return;
        LightProbes probes = BakedProbes();
        if (probes == null || probes.bakedProbes == null || probes.bakedProbes.Length == 0)
        {
            Debug.LogError("Tetralight: the scene has no baked probes; bake its lighting first.");
            return;
        }
        int written = Write(file, probes);
        LightProbes.Tetrahedralize();
        string counts = written + " of " + file.Count + " probes have their light.";
        if (written == file.Count) Debug.Log("Tetralight: " + counts);
        else Debug.LogWarning("Tetralight: " + counts + " The others were not in the bake.");
    }

    // From Unity 6 on the copy that the scene uses; before that the asset itself.
    static LightProbes BakedProbes()
    {
#if UNITY_6000_0_OR_NEWER
        return LightProbes.GetInstantiatedLightProbesForScene(SceneManager.GetActiveScene());
#else
        return LightmapSettings.lightProbes;
#endif
    }

    static int Write(ProbeFile file, LightProbes probes)
    {
#if UNITY_6000_0_OR_NEWER
        Vector3[] positions = probes.GetPositionsSelf();
#else
        Vector3[] positions = probes.positions;
#endif
        Dictionary<Vector3Int, List<int>> places = Places(file);
        SphericalHarmonicsL2[] light = probes.bakedProbes;
        var isWritten = new bool[file.Count];
        for (int i = 0; i < positions.Length && i < light.Length; ++i)
        {
            int probe = Nearest(file, places, positions[i]);
            if (probe < 0) continue;
            light[i] = file.Light(probe);
            positions[i] = file.Position(probe);
            isWritten[probe] = true;
        }
        probes.bakedProbes = light;
#if UNITY_6000_0_OR_NEWER
        probes.SetPositionsSelf(positions, false);
#else
        EditorUtility.SetDirty(probes);
        AssetDatabase.SaveAssets();
#endif
        return Array.FindAll(isWritten, isThere => isThere).Length;
    }

    static Vector3Int Place(Vector3 position)
    {
        return Vector3Int.FloorToInt(position * (0.1f / Tolerance));
    }

    static Dictionary<Vector3Int, List<int>> Places(ProbeFile file)
    {
        var places = new Dictionary<Vector3Int, List<int>>();
        for (int i = 0; i < file.Count; ++i)
        {
            Vector3Int place = Place(file.Position(i));
            List<int> probes;
            if (!places.TryGetValue(place, out probes)) places[place] = probes = new List<int>();
            probes.Add(i);
        }
        return places;
    }

    static int Nearest(ProbeFile file, Dictionary<Vector3Int, List<int>> places, Vector3 position)
    {
        int nearest = -1;
        float least = Tolerance;
        for (int i = 0; i < 27; ++i)
        {
            var step = new Vector3Int(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            List<int> probes;
            if (!places.TryGetValue(Place(position) + step, out probes)) continue;
            foreach (int probe in probes)
            {
                float distance = Vector3.Distance(file.Position(probe), position);
                if (distance > least) continue;
                least = distance;
                nearest = probe;
            }
        }
        return nearest;
    }

    static ProbeFile ReadSelected()
    {
        var text = (TextAsset)Selection.activeObject;
        ProbeFile file = null;
        try
        {
            file = JsonUtility.FromJson<ProbeFile>(text.text);
        }
        catch (ArgumentException error)
        {
            Debug.LogError("Tetralight: " + text.name + ": " + error.Message);
            return null;
        }
        bool isRight = file != null && file.format == "tetralight unity" && file.version == 1
            && file.positions != null && file.coefficients != null
            && file.coefficients.Length == 9 * file.positions.Length;
        if (isRight) return file;
        Debug.LogError("Tetralight: " + text.name + " does not hold probes for Unity.");
        return null;
    }
}
)cs";

/// What world positions in floats lose.
std::vector<std::string> rounding_notes(const ProbeVolumeView& volume) {
    double largest = 0.0;
    for (uint32_t i = 0; i < volume.probe_count(); ++i) {
        const glm::dvec3 position = world_position(volume, i);
        largest = std::max(largest, glm::distance(position, glm::dvec3(glm::vec3(position))));
    }
    if (largest < kLargeMove) return {};
    return {str_cat("World positions are floats in Unity: rounding moves probes by up to ",
                    static_cast<float>(largest), " m.")};
}

}  // namespace

Result<ExportedVolume> export_unity(const ProbeVolumeView& volume, const ExportSettings& settings) {
    return ExportedVolume{
        {{settings.name + ".json", probes_json(volume)}, {"TetralightProbes.cs", kUnityScript}},
        rounding_notes(volume),
        {}};
}

}  // namespace tetralight::detail
