// SPDX-License-Identifier: Apache-2.0
// Checks the extension of glTF files against its JSON schemas by Ajv, that the schemas refuse wrong
// members, and that each accessor has the type that the schema names: MODULES SCHEMAS FILE...
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';

const [modules, schemas, ...files] = process.argv.slice(2);
const Ajv = createRequire(`${modules}/`)('ajv/dist/2020').default;
const ajv = new Ajv({ strict: true, allowUnionTypes: true });
const name = 'TETRALIGHT_probe_volume';
const read = (owner) => JSON.parse(fs.readFileSync(`${schemas}/${owner}.${name}.schema.json`));
const schema = read('glTF');
const isExtension = ajv.compile(schema);
const isNode = ajv.compile(read('node'));

const componentTypes = { float: 5126, 'unsigned byte': 5121, 'unsigned short': 5123, 'unsigned int': 5125 };
function checkAccessors(gltf, object, properties) {
    for (const [member, { $ref, description }] of Object.entries(properties)) {
        if ($ref !== '#/$defs/accessor' || object[member] === undefined) continue;
        const accessor = gltf.accessors[object[member]];
        const [type, component] = description.split(/[,:] /);
        assert.deepEqual([accessor.type, accessor.componentType], [type, componentTypes[component]], member);
    }
}

function refuses(extension, change) {
    const wrong = structuredClone(extension);
    change(wrong.volumes[0], wrong);
    assert.ok(!isExtension(wrong), change.toString());
}

assert.ok(files.length > 0);
for (const file of files) {
    const bytes = fs.readFileSync(file);
    const gltf = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
    const extension = gltf.extensions[name];
    assert.ok(isExtension(extension), file + JSON.stringify(isExtension.errors));
    assert.ok(isNode(gltf.nodes[0].extensions[name]), file);
    const [volume] = extension.volumes;
    checkAccessors(gltf, volume, schema.$defs.volume.properties);
    if (volume.walls) checkAccessors(gltf, volume.walls, schema.$defs.walls.properties);
    for (const member of schema.$defs.volume.required) refuses(extension, (v) => delete v[member]);
    refuses(extension, (v) => (v.shape = 'cubes'));
    refuses(extension, (v) => v.ambient.pop());
    refuses(extension, (v) => (v.version = 2));
    refuses(extension, (v) => (v.positions = -1));
    refuses(extension, (v) => (v.cellVertices = '1'));
    refuses(extension, (v) => (v.walls = { cells: 1 }));
    refuses(extension, (v) => (v.unknown = 1));
    refuses(extension, (v, e) => (e.volumes = []));
    assert.ok(!isNode({}) && !isNode({ volume: 0.5 }));
}
