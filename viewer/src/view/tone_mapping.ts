// SPDX-License-Identifier: Apache-2.0
// The tone mappings of the view, and the same on the processor: ShaderChunk/tonemapping_pars_fragment of three.
import * as three from 'three';

type Rgb = readonly number[];

interface ToneMapping {
    name: string;  // in the address
    text: string;
    toneMapping: three.ToneMapping;
    /** Of linear sRGB that is exposed; the result is linear, too. */
    map(color: Rgb): number[];
}

export const kToneMappings: readonly ToneMapping[] = [
    {name: 'neutral', text: 'Neutral: colours as they are', toneMapping: three.NeutralToneMapping, map: neutral},
    {name: 'agx', text: 'AgX: soft highlights', toneMapping: three.AgXToneMapping, map: agx},
    {name: 'aces', text: 'ACES: contrast of film', toneMapping: three.ACESFilmicToneMapping, map: aces},
];

export function toneNamed(name: string | undefined): three.ToneMapping {
    return (kToneMappings.find(each => each.name === name) ?? kToneMappings[0]).toneMapping;
}

const entryOf = (toneMapping: three.ToneMapping) => kToneMappings.find(each => each.toneMapping === toneMapping)!;

export function nameOfTone(toneMapping: three.ToneMapping): string {
    return entryOf(toneMapping).name;
}

/** The color that the view shows for a radiance: sRGB, 0 to 255. */
export function shownColor(radiance: Rgb, exposure: number, toneMapping: three.ToneMapping): number[] {
    const color = entryOf(toneMapping).map(radiance.map(x => Math.max(0, x * exposure)));
    return color.map(x => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055)));
}

const clamped = (color: Rgb) => color.map(x => Math.min(1, Math.max(0, x)));

/** Rows times a color. */
const times = (rows: readonly Rgb[], [r, g, b]: Rgb) => rows.map(([x, y, z]) => x * r + y * g + z * b);

/** Khronos PBR Neutral. */
function neutral(exposed: Rgb): number[] {
    const kDark = 0.08;
    const kStart = 0.8 - kDark / 2;
    const least = Math.min(...exposed);
    const offset = least < kDark ? least - 6.25 * least * least : kDark / 2;
    const color = exposed.map(x => x - offset);
    const peak = Math.max(...color);
    if (peak < kStart) return color;
    const d = 1 - kStart;
    const newPeak = 1 - d * d / (peak + d - kStart);
    const share = 1 - 1 / (0.15 * (peak - newPeak) + 1);
    return color.map(x => x * newPeak / peak * (1 - share) + newPeak * share);
}

const kRec2020FromSrgb = [[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0113], [0.0164, 0.0880, 0.8956]];
const kSrgbFromRec2020 = [[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]];
const kAgxInset = [[0.856627153315983, 0.0951212405381588, 0.0482516061458583],
                   [0.137318972929847, 0.761241990602591, 0.101439036467562],
                   [0.11189821299995, 0.0767994186031903, 0.811302368396859]];
const kAgxOutset = [[1.1271005818144368, -0.11060664309660323, -0.016493938717834573],
                    [-0.1413297634984383, 1.157823702216272, -0.016493938717834257],
                    [-0.14132976349843826, -0.11060664309660294, 1.2519364065950405]];

function agx(exposed: Rgb): number[] {
    const [low, high] = [-12.47393, 4.026069];  // stops
    const inset = times(kAgxInset, times(kRec2020FromSrgb, exposed));
    const coded = clamped(inset.map(x => (Math.log2(Math.max(x, 1e-10)) - low) / (high - low)));
    const curved = coded.map(x => (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232);
    const linear = times(kAgxOutset, curved).map(x => Math.max(0, x) ** 2.2);
    return clamped(times(kSrgbFromRec2020, linear));
}

const kAcesInput = [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
const kAcesOutput = [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

function aces(exposed: Rgb): number[] {
    const fit = (v: number) => (v * (v + 0.0245786) - 0.000090537) / (v * (v * 0.983729 + 0.4329510) + 0.238081);
    return clamped(times(kAcesOutput, times(kAcesInput, exposed.map(x => x / 0.6)).map(fit)));
}
