// SPDX-License-Identifier: Apache-2.0
// What `bench viewer` compares loading with: three's GLTFLoader, one ambient light, one picture, nothing else.
// The address holds the path of the scene, the size of the picture, and the camera.
import * as three from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';

const link = new URLSearchParams(location.hash.slice(1));
const numbers = (key: string) => link.get(key)!.split(',').map(Number);
const [width, height] = numbers('size');

const renderer = new three.WebGLRenderer({antialias: true});
renderer.setSize(width, height);
renderer.toneMapping = three.NeutralToneMapping;
renderer.shadowMap.enabled = link.has('shadows');
document.body.append(renderer.domElement);

const camera = new three.PerspectiveCamera(50, width / height, 0.05, 2000);
camera.position.fromArray(numbers('eye'));
camera.lookAt(...numbers('target') as [number, number, number]);

const bytes = await (await fetch(link.get('scene')!)).arrayBuffer();
const {scene} = await new GLTFLoader().parseAsync(bytes, '');
scene.add(new three.AmbientLight(0xffffff, 2));
scene.traverse(node => {
    if (node instanceof three.DirectionalLight || node instanceof three.Mesh) node.castShadow = node.receiveShadow = true;
});
renderer.render(scene, camera);
document.body.dataset.state = 'ready';
Object.assign(window, {renderer, draw: () => renderer.render(scene, camera)});
