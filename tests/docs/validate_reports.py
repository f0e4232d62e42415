"""Validates reports against a JSON schema: validate_reports.py SCHEMA[#DEFINITION] REPORT..."""
import json
import sys

import jsonschema

path, _, definition = sys.argv[1].partition("#")
schema = json.load(open(path))
jsonschema.Draft7Validator.check_schema(schema)
if definition:
    schema = {"definitions": schema["definitions"], "$ref": f"#/definitions/{definition}"}
wrong = 0
for name in sys.argv[2:]:
    for error in jsonschema.Draft7Validator(schema).iter_errors(json.load(open(name))):
        print(f"{name}: {'.'.join(map(str, error.absolute_path))}: {error.message[:300]}")
        wrong += 1
sys.exit(wrong > 0)
