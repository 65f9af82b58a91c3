// SPDX-License-Identifier: Apache-2.0

/** The nearest multiple of a step; a step of 0 changes nothing. */
export function snap(value: number, step: number): number {
    if (!(step > 0)) return value;
    return Number((Math.round(value / step) * step).toFixed(9)) + 0;  // 0.3, not 0.30000000000000004; never −0
}

/** Where something ends that is moved: on multiples of the step along the axes along which it moves. */
export function snapPosition(start: readonly number[], to: readonly number[], step: number): [number, number, number] {
    return [0, 1, 2].map(i => to[i] === start[i] ? start[i] : snap(to[i], step)) as [number, number, number];
}

/** Steps of the handles and of the keys. */
export class Snapping {
    isOn = true;
    /** Ctrl is held: handles move freely. */
    isHeldOff = false;
    meters = 0.25;
    degrees = 15;

    /** Metres; 0: free. */
    get step(): number {
        return this.isOn && !this.isHeldOff ? this.meters : 0;
    }

    /** Degrees; 0: free. */
    get angle(): number {
        return this.isOn && !this.isHeldOff ? this.degrees : 0;
    }
}
