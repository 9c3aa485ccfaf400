"""osl.py FOLDER: compiles FOLDER/functions.osl by the compiler of OSL in Cycles, and runs it there.

Its `evaluate(int row, float x, float y, float z, float w, output float a, output float b)` gives the
values of a row's point. FOLDER/points.f32 has the points, FOLDER/values.f32 gets the values, four numbers each."""
import array, pathlib, sys
import bpy
import addon_utils

# What the module of bpy brings along: oslquery.
sys.path += map(str, pathlib.Path(bpy.utils.resource_path("LOCAL")).glob("python/lib/python*/site-packages"))

WIDTH = 256
# Light is never negative: of each value what is above 0 and what is below are pictures of their own.
SHADER = """
#include "{functions}"
shader values(color first = 0, float last = 0, color place = 0, float sign = 1, output color value = 0)
{{
    float a = 0, b = 0;
    evaluate((int)(place[0]*{width} + place[1]), first[0], first[1], first[2], last, a, b);
    value = color(max(sign*a, 0.0), max(sign*b, 0.0), 0);
}}
"""


def new_scene(height):
    """A plane that the camera sees pixel by pixel, lit by itself alone; its material's nodes."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("cycles")
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine, cycles.device, cycles.shading_system = "CYCLES", "CPU", True
    cycles.samples, cycles.max_bounces, cycles.pixel_filter_type = 1, 0, "BOX"
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, height, 100
    settings = render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    scene.view_settings.view_transform = "Raw"
    size = height / WIDTH
    mesh = bpy.data.meshes.new("plane")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, size, 0), (0, size, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new().data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
    scene.collection.objects.link(bpy.data.objects.new("plane", mesh))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", max(1, size)
    camera.location = (0.5, size / 2, 1)
    scene.collection.objects.link(camera)
    scene.camera = camera
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    mesh.materials.append(material)
    material.node_tree.nodes.clear()
    return scene, material.node_tree


def image_node(tree, name, height, texels):
    image = bpy.data.images.new(name, WIDTH, height, float_buffer=True, alpha=True)
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"
    image.pixels.foreach_set(texels)
    image.update()
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, node.interpolation = image, "Closest"
    return node


def script_node(tree, source):
    script = tree.nodes.new("ShaderNodeScript")
    script.mode, script.filepath = "EXTERNAL", str(source)
    said = []
    from cycles import osl
    osl.update_script_node(script, lambda level, text: said.append(text))
    if not source.with_suffix(".oso").exists():
        sys.exit("\n".join(said))
    return script


def rendered(scene, folder, height):
    scene.render.filepath = str(folder / "picture.exr")
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    picture.colorspace_settings.name = "Non-Color"
    pixels = array.array("f", bytes(16 * WIDTH * height))
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    return pixels


def main(folder):
    points = array.array("f", (folder / "points.f32").read_bytes())
    height = -(-len(points) // (4 * WIDTH))
    texels = points + array.array("f", bytes(16 * WIDTH * height - 4 * len(points)))
    places = array.array("f", [v for y in range(height) for x in range(WIDTH) for v in (y, x, 0, 1)])
    scene, tree = new_scene(height)
    # Other shaders in the folder are only taken.
    for other in sorted(set(folder.glob("*.osl")) - {folder / "functions.osl"}):
        tree.nodes.remove(script_node(tree, other))
    source = folder / "values.osl"
    source.write_text(SHADER.format(functions=folder / "functions.osl", width=WIDTH))
    script, emission = script_node(tree, source), tree.nodes.new("ShaderNodeEmission")
    point, place = image_node(tree, "points", height, texels), image_node(tree, "places", height, places)
    surface = tree.nodes.new("ShaderNodeOutputMaterial")
    for output, to in [(point.outputs["Color"], script.inputs["first"]),
                       (point.outputs["Alpha"], script.inputs["last"]),
                       (place.outputs["Color"], script.inputs["place"]),
                       (script.outputs["value"], emission.inputs["Color"]),
                       (emission.outputs[0], surface.inputs["Surface"])]:
        tree.links.new(output, to)
    above = rendered(scene, folder, height)
    script.inputs["sign"].default_value = -1
    below = rendered(scene, folder, height)
    values = array.array("f", (a - b for a, b in zip(above, below)))
    (folder / "values.f32").write_bytes(values[:len(points)].tobytes())


main(pathlib.Path(sys.argv[1]).resolve())
