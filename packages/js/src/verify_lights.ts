// SPDX-License-Identifier: Apache-2.0
import {checkCount, isUnit} from './checks.js';
import {elementError} from './error.js';
import {kLightSize, VolumeData} from './volume_data.js';

enum Type { Directional, Point, Spot, Rectangle, Disc }

/** Each light has the directions and sizes of its type. */
export function checkLights(v: VolumeData): void {
    const count = v.lights.byteLength / kLightSize;
    checkCount('light_names', v.lightNames.length, count);
    for (let i = 0; i < count; ++i) {
        const problem = lightProblem(v.lights, i * kLightSize);
        if (problem !== '') throw elementError('lights', i, problem);
    }
}

/** What is wrong with a light; empty if nothing is. */
function lightProblem(lights: DataView, at: number): string {
    const word = (offset: number) => lights.getUint32(at + offset, true);
    const number = (offset: number) => lights.getFloat32(at + offset, true);
    const vector = (offset: number) => [number(offset), number(offset + 4), number(offset + 8)];
    const [intensity, position, direction, tangent] = [8, 20, 32, 68].map(vector);
    const [inner, outer] = [number(48), number(52)];
    const sizes = [...intensity, number(44), number(60), number(64), number(80), number(84)];
    const numbers = [...sizes, ...position, ...direction, ...tangent, inner, outer];
    const type = word(0);
    if (type > Type.Disc || word(4) > 2 || word(56) > 3 || !numbers.every(Number.isFinite)) return 'is not a light';
    if (!sizes.every(size => size >= 0)) return 'has a negative size or intensity';
    if (type !== Type.Point && !isUnit(direction, 1e-3)) return 'has a direction that is not a unit vector';
    if (type === Type.Spot && !(inner >= outer && inner <= 1 && outer >= -1)) return 'has no cone';
    if (type !== Type.Rectangle) return '';
    if (!isUnit(tangent, 1e-3)) return 'has a tangent that is not a unit vector';
    const cosine = tangent.reduce((sum, x, i) => sum + x * direction[i], 0);
    return Math.abs(cosine) > 1e-3 ? 'has a tangent that is not at right angles to its direction' : '';
}
