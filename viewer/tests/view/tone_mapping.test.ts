// SPDX-License-Identifier: Apache-2.0
import * as three from 'three';
import {expect, test} from 'vitest';

import {kToneMappings, nameOfTone, shownColor, toneNamed} from '../../src/view/tone_mapping';

test('names lead to tone mappings and back; what is not known is the first', () => {
    for (const {name} of kToneMappings) expect(nameOfTone(toneNamed(name))).toBe(name);
    expect(toneNamed('other')).toBe(three.NeutralToneMapping);
    expect(toneNamed(undefined)).toBe(three.NeutralToneMapping);
});

test.each(kToneMappings.map(({name, toneMapping}) => [name, toneMapping] as const))(
    '%s keeps the order of channels, stays in range, and depends on exposed light only', (_, toneMapping) => {
        const [red, green, blue] = shownColor([0.5, 0.2, 0.1], 1, toneMapping);
        expect(red).toBeGreaterThan(green);
        expect(green).toBeGreaterThan(blue);
        for (const channel of shownColor([1e6, 1e5, 1e3], 8, toneMapping)) expect(channel).toBeLessThanOrEqual(255);
        expect(shownColor([0.1, 0.2, 0.3], 2, toneMapping)).toEqual(shownColor([0.2, 0.4, 0.6], 1, toneMapping));
        const [r, g, b] = shownColor([0.18, 0.18, 0.18], 1, toneMapping);
        expect(Math.max(r, g, b) - Math.min(r, g, b)).toBeLessThanOrEqual(1);
    });

/** sRGB of a linear value. */
const coded = (x: number) => Math.round(255 * (1.055 * x ** (1 / 2.4) - 0.055));

test('middle grey is what each of them is known for', () => {
    const grey = (toneMapping: three.ToneMapping) => shownColor([0.18, 0.18, 0.18], 1, toneMapping)[1];
    expect(grey(three.NeutralToneMapping)).toBe(coded(0.18 - 0.04));
    // The fit of ACES at 0.18 / 0.6, by hand.
    expect(grey(three.ACESFilmicToneMapping)).toBeCloseTo(coded((0.3 * 0.3245786 - 0.000090537) / (0.3 * 0.7280697 + 0.238081)), -0.5);
    // Filament's AgX keeps middle grey at about a half of the curve: 0.5 ** 2.2.
    expect(Math.abs(grey(three.AgXToneMapping) - coded(0.5 ** 2.2))).toBeLessThan(12);
});
