"""The wheel, and what is said where the library or the program is not there."""
import base64
import hashlib
import json
import os
import re
import subprocess
import sys
import zipfile

import pytest
from conftest import source

import signorini

command = [sys.executable, "-c", "import wheel_backend, sys; print(wheel_backend.build_wheel(sys.argv[1]))"]


def build(folder, **environment):
    return subprocess.run([*command, str(folder)], cwd=source / "python", env=os.environ | environment, capture_output=True,
                          text=True)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    built = build(folder)
    assert built.returncode == 0, built.stderr
    return folder / built.stdout.strip()


def test_the_wheel_holds_the_library_and_says_for_what_it_is(wheel):
    version = re.search(r"^project\(signorini VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text(), re.M).group(1)
    assert wheel.name == f"signorini-{version}-py3-none-linux_x86_64.whl"
    with zipfile.ZipFile(wheel) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    information = f"signorini-{version}.dist-info"
    assert files["signorini/libsignorini_c.so.2"].startswith(b"\x7fELF")
    assert "signorini/py.typed" in files and f"{information}/LICENSE" in files
    assert b"Tag: py3-none-linux_x86_64" in files[f"{information}/WHEEL"]
    assert b"Requires-Dist: numpy" in files[f"{information}/METADATA"]
    gpl = "signorini/libsignorini_cholmod.so" in files
    assert (b"GPL" in files[f"{information}/METADATA"]) == gpl
    for line in files[f"{information}/RECORD"].decode().splitlines():
        name, digest, size = line.rsplit(",", 2)
        if digest:
            expected = base64.urlsafe_b64encode(hashlib.sha256(files[name]).digest()).rstrip(b"=").decode()
            assert digest == f"sha256={expected}" and int(size) == len(files[name])


def test_an_installed_prefix_makes_a_wheel_of_its_own_library(tmp_path):
    tree = os.environ.get("SIGNORINI_BUILD", source / "build" / "release-assert")
    for component in ("dev", "c", "gpl"):
        subprocess.run(["cmake", "--install", tree, "--prefix", tmp_path, "--component", component], check=True,
                       capture_output=True)
    installed = tmp_path / "share" / "signorini" / "python"
    environment = {key: value for key, value in os.environ.items() if key != "SIGNORINI_LIBRARY"}
    made = subprocess.run([*command, str(tmp_path)], cwd=installed, env=environment, capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    library = next(tmp_path.rglob("lib*/libsignorini_c.so.2"))
    with zipfile.ZipFile(tmp_path / made.stdout.strip()) as archive:
        assert archive.read("signorini/libsignorini_c.so.2") == library.read_bytes()
        assert json.loads(archive.read("signorini/_build.json"))["library_folder"] == str(library.parent)


def test_the_same_files_make_the_same_wheel(wheel, tmp_path):
    assert build(tmp_path).returncode == 0
    assert (tmp_path / wheel.name).read_bytes() == wheel.read_bytes()


def test_a_library_that_is_not_there_is_asked_for(tmp_path, monkeypatch):
    missing = build(tmp_path, SIGNORINI_LIBRARY=str(tmp_path))
    assert missing.returncode != 0 and f"there is no file {tmp_path}/libsignorini_c.so.2" in missing.stderr
    assert not list(tmp_path.iterdir())
    monkeypatch.delenv("SIGNORINI_LIBRARY", raising=False)
    monkeypatch.setattr(signorini._search, "LIBRARY", "libnowhere.so")
    with pytest.raises(FileNotFoundError, match="(?s)SIGNORINI_LIBRARY.*Searched:.*/usr/local/lib/libnowhere.so"):
        signorini._search.find_library()
    monkeypatch.delenv("SIGNORINI_PROGRAM", raising=False)
    monkeypatch.setattr(signorini._search, "PROGRAM", "nowhere")
    searched = "(?s)SIGNORINI_PROGRAM.*Searched:.*/usr/local/bin/nowhere.*/of/bin/nowhere"
    with pytest.raises(FileNotFoundError, match=searched):
        signorini._search.find_program("/of/lib")


def test_code_for_another_processor_is_refused(monkeypatch):
    monkeypatch.setattr(signorini._library, "built", lambda: {"instructions": ["avx1024"]})
    beside = signorini._library.Path(signorini._library.__file__).resolve().parent / "libsignorini_c.so.2"
    with pytest.raises(ImportError, match="a processor with avx1024.*SIGNORINI_NATIVE=OFF"):
        signorini._library._require_processor(beside)
    signorini._library._require_processor(source / "libsignorini_c.so.2")  # not of the wheel
