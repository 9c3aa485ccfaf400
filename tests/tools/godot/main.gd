extends Node

# As the pages have it: so many points a line, of four numbers each.
const WIDTH := 256

# Bytes are exact where a picture of floats cannot be had: the four quarters of the picture have the bits of the
# four values.
const FRAGMENT := """
void fragment() {
	ivec2 pixel = ivec2(UV * vec2(4.0 * WIDTH.0, HEIGHT.0));
	ivec2 at = ivec2(pixel.x % WIDTH, pixel.y);
	vec4 values = evaluate(at.y * WIDTH + at.x, texelFetch(points, at, 0));
	uint bits = floatBitsToUint(values[pixel.x / WIDTH]);
	COLOR = vec4(float(bits & 255u), float((bits >> 8u) & 255u), float((bits >> 16u) & 255u), float(bits >> 24u)) / 255.0;
}
"""

func _ready():
	var data := FileAccess.get_file_as_bytes("res://points.f32")
	var count := data.size() / 16
	var height := (count + WIDTH - 1) / WIDTH
	data.resize(16 * WIDTH * height)
	var points := ImageTexture.create_from_image(Image.create_from_data(WIDTH, height, false, Image.FORMAT_RGBAF, data))
	var shader := Shader.new()
	shader.code = "shader_type canvas_item;\nrender_mode blend_disabled, unshaded;\n" \
		+ "uniform highp sampler2D points : filter_nearest;\n#include \"res://functions.gdshaderinc\"\n" \
		+ FRAGMENT.replace("WIDTH", str(WIDTH)).replace("HEIGHT", str(height))
	var material := ShaderMaterial.new()
	material.shader = shader
	material.set_shader_parameter("points", points)
	var rect := ColorRect.new()
	rect.size = Vector2(4 * WIDTH, height)
	rect.material = material
	var viewport := SubViewport.new()
	viewport.size = Vector2i(4 * WIDTH, height)
	viewport.transparent_bg = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	viewport.add_child(rect)
	add_child(viewport)
	for i in 3:
		await RenderingServer.frame_post_draw
	var pixels := viewport.get_texture().get_image().get_data()
	var values := PackedByteArray()
	for row in count:
		for quarter in 4:
			var at := 4 * ((row / WIDTH) * 4 * WIDTH + quarter * WIDTH + row % WIDTH)
			values.append_array(pixels.slice(at, at + 4))
	JavaScriptBridge.eval("window.values('%s')" % Marshalls.raw_to_base64(values))
