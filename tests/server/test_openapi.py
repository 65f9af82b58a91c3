# SPDX-License-Identifier: Apache-2.0
"""The description of the service is well formed, and is of this service."""
import json
import os
import re
import subprocess
import unittest

from service import ServiceTest

METHODS = ("get", "post", "put", "patch", "delete", "head", "options")


class OpenApi(ServiceTest):
    def setUp(self):
        super().setUp()
        self.server = self.start()
        self.document = self.server.get("/openapi.json").json()

    def operations(self):
        for path, item in self.document["paths"].items():
            for method, operation in item.items():
                self.assertIn(method, METHODS)
                yield path, method, operation

    def test_it_is_openapi_3_1(self):
        self.assertEqual(self.document["openapi"], "3.1.0")
        self.assertLessEqual({"title", "version"}, self.document["info"].keys())

    def test_a_validator_of_others_takes_it(self):
        validator = os.path.join(os.environ.get("TETRALIGHT_NODE_MODULES", ""), "@seriousme",
                                 "openapi-schema-validator", "bin", "validate-api-cli.js")
        if not os.path.exists(validator):
            self.skipTest("npm has not installed openapi-schema-validator")
        def verdict(document):
            path = os.path.join(self.folder, "openapi.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(document, file)
            done = subprocess.run(["node", validator, path], capture_output=True, text=True)
            return json.loads(done.stdout)
        self.assertEqual(verdict(self.document), {"valid": True})
        broken = dict(self.document, paths={"/": {"get": {"responses": 7}}})
        self.assertFalse(verdict(broken)["valid"])

    def test_operations_are_whole(self):
        ids = []
        tags = {tag["name"] for tag in self.document["tags"]}
        for path, method, operation in self.operations():
            with self.subTest(path=path, method=method):
                ids.append(operation["operationId"])
                self.assertTrue(operation["summary"])
                self.assertLessEqual(set(operation["tags"]), tags)
                self.assertIn("default", operation["responses"])
                self.assertTrue(any(code.startswith("2") for code in operation["responses"]))
                for response in operation["responses"].values():
                    self.assertTrue("$ref" in response or response["description"])
                in_path = {p["name"] for p in operation.get("parameters", []) if p["in"] == "path"}
                self.assertEqual(in_path, set(re.findall(r"\{(\w+)\}", path)))
                for parameter in operation.get("parameters", []):
                    self.assertIn("schema", parameter)
                    self.assertTrue(parameter["required"] or parameter["in"] == "query")
                self.assertTrue("requestBody" not in operation or method in ("post", "patch", "put"))
        self.assertEqual(len(ids), len(set(ids)))

    def test_references_lead_somewhere(self):
        def visit(value):
            if isinstance(value, dict):
                if "$ref" in value:
                    target = self.document
                    for part in value["$ref"].removeprefix("#/").split("/"):
                        target = target[part]
                for member in value.values():
                    visit(member)
            elif isinstance(value, list):
                for member in value:
                    visit(member)
        visit(self.document)

    def test_schemas_have_types(self):
        kinds = {"object", "array", "string", "number", "integer", "boolean", "null"}
        def visit(schema):
            self.assertTrue(schema.keys() & {"type", "$ref", "oneOf"}, schema)
            types = schema.get("type", [])
            self.assertLessEqual(set([types] if isinstance(types, str) else types), kinds)
            self.assertLessEqual(set(schema.get("required", [])), schema.get("properties", {}).keys())
            for member in schema.get("properties", {}).values():
                visit(member)
            if "items" in schema:
                visit(schema["items"])
        for schema in self.document["components"]["schemas"].values():
            visit(schema)

    def test_every_operation_is_served_and_nothing_else(self):
        for path, method, _ in self.operations():
            real = re.sub(r"\{\w+\}", "none", path)
            has_no_end = path == "/v1/bakes/events"
            answer = self.server.request("HEAD" if has_no_end else method.upper(), real)
            code = answer.json().get("code") if answer.status >= 400 else None
            self.assertNotIn(code, ("no_such_path", "wrong_method"), path)
        source = os.path.join(os.path.dirname(__file__), "..", "..", "server")
        patterns = set()
        for name in os.listdir(source):
            if name.endswith("_routes.cpp"):
                text = open(os.path.join(source, name)).read()
                patterns |= set(re.findall(r'"(/(?:v1/[^"]*\{[^"]*|v1/\w+|\w+z|version|metrics|'
                                           r'openapi\.json))"', text))
        self.assertLessEqual(patterns, set(self.document["paths"]))

    def test_the_members_of_orders_are_those_that_the_service_accepts(self):
        for path, schema, member in (
                ("/v1/bakes", "BakeOrder", "samples"),
                ("/v1/lightmap-bakes", "LightmapBakeOrder", "texels_per_meter"),
                ("/v1/reflection-bakes", "ReflectionBakeOrder", "cube_size"),
                ("/v1/lightmaps/none/export", "ExportLightmapsOrder", "scene"), ("/v1/grid", "GridOrder", "spacing"),
                ("/v1/lppv", "LppvOrder", "density"), ("/v1/check-leaks", "CheckLeaksOrder", "places"),
                ("/v1/render", "RenderOrder", "camera"),
                ("/v1/relight", "RelightOrder", "weights"),
                ("/v1/lightmaps/none/relight", "RelightLightmapsOrder", "weights"),
                ("/v1/tetrahedralize", "TetrahedralizeOrder", "groups")):
            properties = self.document["components"]["schemas"][schema]["properties"]
            self.assertIn(member, properties)
            for name in [*properties, "output", "threads", "chunks", "no_setting"]:
                with self.subTest(path=path, member=name):
                    problem = self.server.post(path, {name: {}}).json()
                    is_unknown = problem["code"] == "unknown_member"
                    self.assertEqual(is_unknown, name not in properties, problem)

    def test_settings_have_the_description_limits_and_default_of_their_table(self):
        schemas = self.document["components"]["schemas"]
        bake = schemas["BakeOrder"]["properties"]
        self.assertEqual(bake["bounces"]["default"], 1000)
        self.assertEqual((bake["min_validity"]["minimum"], bake["min_validity"]["maximum"]), (0, 1))
        self.assertIn("hann", bake["dering_window"]["enum"])
        self.assertEqual((bake["scene"]["x-stored"], bake["reuse"]["x-stored"]), ("scenes", "volumes"))
        self.assertIn("scene", schemas["BakeOrder"]["required"])
        render = schemas["RenderOrder"]["properties"]
        self.assertEqual([render[name]["x-stored"] for name in ("volume", "lightmaps", "reflections")],
                         ["volumes", "lightmaps", "reflections"])
        self.assertEqual(set(schemas["Query"]["properties"]),
                         {"positions", "normals", "normal_offset", "outside", "fade", "walls",
                          "rendering_layers", "radius", "precision"})
        text = json.dumps(schemas)
        self.assertNotIn("x-settings", text)
        self.assertNotIn("--", text)
        for order in ("BakeOrder", "LightmapBakeOrder", "ReflectionBakeOrder", "ExportLightmapsOrder", "GridOrder", "CheckLeaksOrder", "LppvOrder", "RenderOrder", "RelightOrder",
                      "RelightLightmapsOrder"):
            for name, setting in schemas[order]["properties"].items():
                self.assertTrue(setting["description"], name)


if __name__ == "__main__":
    unittest.main()
