// SPDX-License-Identifier: Apache-2.0
// The canvas: renderer, camera, and a picture whenever something changed.
import * as three from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {middleGreyExposure, takeToneMappingBack} from './exposure';
import {kFov} from './first_view';
import {Sky} from './sky';

export class Stage {
    readonly renderer: three.WebGLRenderer;
    readonly scene = new three.Scene();
    readonly sky = new Sky();
    readonly camera = new three.PerspectiveCamera(kFov, 1, 0.05, 2000);
    readonly controls: OrbitControls;
    readonly canvas: HTMLCanvasElement;
    /** Called when the exposure was found, not given. */
    exposed = () => {};
    private isDue = false;

    constructor(readonly parent: HTMLElement) {
        this.renderer = new three.WebGLRenderer({antialias: true});
        this.canvas = this.renderer.domElement;
        this.canvas.tabIndex = 0;
        this.canvas.setAttribute('role', 'application');
        this.canvas.setAttribute('aria-label', 'The scene in 3D. Arrow keys rotate, with Shift they ' +
            'move, plus and minus come nearer and go away.');
        parent.append(this.canvas);
        this.renderer.toneMapping = three.NeutralToneMapping;
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = three.PCFShadowMap;
        this.sky.radiance.set(0x11151c);
        this.scene.add(this.sky.mesh);
        this.camera.position.set(12, 9, 16);
        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.addEventListener('change', () => this.draw());
        this.canvas.addEventListener('keydown', event => this.turn(event));
        new ResizeObserver(() => this.resize()).observe(parent);
        this.resize();
    }

    /** Draws soon; many calls are one picture. */
    draw(): void {
        if (this.isDue) return;
        this.isDue = true;
        requestAnimationFrame(() => this.drawNow());
    }

    drawNow(): void {
        this.isDue = false;
        this.renderer.render(this.scene, this.camera);
    }

    set exposure(exposure: number) {
        this.renderer.toneMappingExposure = exposure;
        this.draw();
    }

    get exposure(): number {
        return this.renderer.toneMappingExposure;
    }

    /** The exposure that brings the log-average luminance of the view to middle grey, as `render` does. */
    exposeItself(): void {
        this.exposure = middleGreyExposure(this.light(64));
        this.exposed();
    }

    /** The light of the view, RGBA of size² pixels. */
    private light(size: number): Float32Array {
        const kFaint = 2 ** -12;
        const {exposure, renderer} = this;
        const target = new three.WebGLRenderTarget(size, size, {type: three.FloatType});
        // Targets are linear and not tone-mapped, unless they are of headsets: then the shaders are those of the
        // canvas, and half as many are to compile.
        target.texture.colorSpace = renderer.outputColorSpace;
        Object.assign(target, {isXRRenderTarget: true});
        const pixels = new Float32Array(4 * size * size);
        const showMarks = this.hideMarks();
        renderer.toneMappingExposure = kFaint;
        renderer.setRenderTarget(target);
        this.drawNow();
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        renderer.setRenderTarget(null);
        renderer.toneMappingExposure = exposure;
        showMarks();
        target.dispose();
        takeToneMappingBack(pixels, kFaint);
        return pixels;
    }

    /** Hides what has colours of its own whatever the exposure; returns what undoes it. */
    private hideMarks(): () => void {
        const marks: three.Object3D[] = [];
        this.scene.traverseVisible(object => {
            const {material} = object as Partial<three.Mesh>;
            if ([material ?? []].flat().some(({toneMapped}) => !toneMapped)) marks.push(object);
        });
        for (const mark of marks) mark.visible = false;
        return () => { for (const mark of marks) mark.visible = true; };
    }

    look(from: readonly number[], at: readonly number[]): void {
        this.camera.position.fromArray(from as number[]);
        this.controls.target.fromArray(at as number[]);
        this.controls.update();
        this.draw();
    }

    /** Looks at a box as a whole. */
    lookAtAll(box: three.Box3): void {
        const sphere = box.getBoundingSphere(new three.Sphere());
        const direction = new three.Vector3(0.55, 0.5, 0.8).normalize();
        const from = sphere.center.clone().addScaledVector(direction, 1.9 * sphere.radius);
        this.camera.far = Math.max(100, 20 * sphere.radius);
        this.camera.near = this.camera.far / 20000;
        this.camera.updateProjectionMatrix();
        this.look(from.toArray(), sphere.center.toArray());
    }

    /** A ray through a place of the page. */
    rayAt(x: number, y: number): three.Raycaster {
        const box = this.canvas.getBoundingClientRect();
        const place = new three.Vector2(2 * (x - box.left) / box.width - 1,
                                        1 - 2 * (y - box.top) / box.height);
        const caster = new three.Raycaster();
        caster.setFromCamera(place, this.camera);
        return caster;
    }

    /** Where a position of the world is in the page. */
    pageFrom(position: three.Vector3): {x: number; y: number; isInFront: boolean} {
        const box = this.canvas.getBoundingClientRect();
        const p = position.clone().project(this.camera);
        return {x: box.left + (p.x + 1) / 2 * box.width, y: box.top + (1 - p.y) / 2 * box.height,
                isInFront: p.z < 1};
    }

    private resize(): void {
        const {clientWidth: width, clientHeight: height} = this.parent;
        if (width === 0 || height === 0) return;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.drawNow();
    }

    private turn(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const offset = this.camera.position.clone().sub(this.controls.target);
        const spherical = new three.Spherical().setFromVector3(offset);
        const step = 0.1;
        const moves: Record<string, [number, number]> = {
            ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
        };
        const move = moves[event.key];
        if (move !== undefined && event.shiftKey) {
            const right = new three.Vector3().setFromMatrixColumn(this.camera.matrix, 0);
            const up = new three.Vector3().setFromMatrixColumn(this.camera.matrix, 1);
            const way = right.multiplyScalar(move[0]).addScaledVector(up, move[1])
                            .multiplyScalar(0.05 * spherical.radius);
            this.controls.target.add(way);
        } else if (move !== undefined) {
            spherical.theta += step * move[0];
            spherical.phi = Math.min(Math.PI - 0.05, Math.max(0.05, spherical.phi - step * move[1]));
        } else if (event.key === '+' || event.key === '=') {
            spherical.radius *= 0.9;
        } else if (event.key === '-') {
            spherical.radius /= 0.9;
        } else {
            return;
        }
        event.preventDefault();
        this.camera.position.setFromSpherical(spherical).add(this.controls.target);
        this.controls.update();
        this.controls.dispatchEvent({type: 'end'});  // as after a drag
        this.draw();
    }
}
