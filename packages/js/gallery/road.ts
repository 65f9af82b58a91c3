// SPDX-License-Identifier: Apache-2.0
// Where the ball goes, and from where it is seen. The scene is examples/scenes/courtyard.glb.

export type Position = readonly [number, number, number];

export interface Station {
    name: string;
    position: Position;
}

export const kStations: readonly Station[] = [
    {name: 'blue lamp', position: [5.9, 0.6, -0.2]},
    {name: 'lawn', position: [3.2, 0.6, 8.2]},
    {name: 'pergola', position: [-6.9, 0.6, 3.2]},
    {name: 'door', position: [1.9, 0.65, 3.3]},
    {name: 'orange lamp', position: [-0.5, 0.9, -1.6]},
    {name: 'red wall', position: [-3.2, 1.2, -1.2]},
];

export const kRadius = 0.5;

/** From the ball to the camera. */
export const kEye: Position = [0.9, 0.5, 2.5];
export const kFieldOfView = 26;  // vertical, degrees

/** Radius of the outline of the ball as a share of half of the picture. */
export const kOutline = Math.tan(Math.asin(kRadius / Math.hypot(...kEye))) / Math.tan(kFieldOfView / 2 * Math.PI / 180);

export const eyeOf = (ball: Position): Position => [ball[0] + kEye[0], ball[1] + kEye[1], ball[2] + kEye[2]];

/** The camera of the picture of the whole scene. */
export const kOverview = {eye: [6.2, 4.4, 18.5], target: [-0.3, 0.75, 0], fieldOfView: 29, width: 1120, height: 400};

/** The place of a position in that picture: from its left and from its top, as shares. */
export function placeInOverview(position: Position): [number, number] {
    const {eye, target, fieldOfView, width, height} = kOverview;
    const forward = unit(minus(target, eye));
    const right = unit(cross(forward, [0, 1, 0]));
    const up = cross(right, forward);
    const to = minus(position, eye);
    const half = dot(to, forward) * Math.tan(fieldOfView / 2 * Math.PI / 180);
    return [0.5 + dot(to, right) / (2 * half * width / height), 0.5 - dot(to, up) / (2 * half)];
}

/** The position after a share of the road from its first station to its last. */
export function positionOnRoad(share: number): Position {
    const along = Math.min(Math.max(share, 0), 1) * (kStations.length - 1);
    const leg = Math.min(Math.floor(along), kStations.length - 2);
    const [from, to] = [kStations[leg].position, kStations[leg + 1].position];
    const eased = (1 - Math.cos(Math.PI * (along - leg))) / 2;
    return from.map((x, axis) => x + eased * (to[axis] - x)) as unknown as Position;
}

const minus = (a: readonly number[], b: readonly number[]) => a.map((x, axis) => x - b[axis]);
const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, x, axis) => sum + x * b[axis], 0);
const cross = ([ax, ay, az]: readonly number[], [bx, by, bz]: readonly number[]) =>
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
const unit = (a: readonly number[]) => a.map(x => x / Math.hypot(...a));
