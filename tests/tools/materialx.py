"""materialx.py FOLDER: validates the documents FOLDER/*.mtlx, and writes shaders of them.

Each document defines a node. FOLDER/pixel.LANGUAGE is a shader of the sum of all their outputs by the
generator of that language."""
import pathlib, sys
import MaterialX as mx
from MaterialX import PyMaterialXGenGlsl as glsl, PyMaterialXGenMdl as mdl, PyMaterialXGenMsl as msl
from MaterialX import PyMaterialXGenOsl as osl, PyMaterialXGenShader as shader
from MaterialX import PyMaterialXGenSlang as slang

GENERATORS = {"glsl": glsl.GlslShaderGenerator, "essl": glsl.EsslShaderGenerator,
              "osl": osl.OslShaderGenerator, "slang": slang.SlangShaderGenerator,
              "msl": msl.MslShaderGenerator, "mdl": mdl.MdlShaderGenerator}


def validate(document, name):
    valid, said = document.validate()
    if not valid:
        sys.exit(f"{name}: {said}")


def loaded(path, library):
    document = mx.createDocument()
    mx.readFromXmlFile(document, str(path))
    document.setDataLibrary(library)
    validate(document, path)
    return document


def instances(document, definitions):
    """A graph that adds up the outputs of a node of each definition, and its output."""
    graph, number, total = document.addNodeGraph("sum_graph"), 0, None
    for place, definition in enumerate(definitions):
        node = graph.addNodeInstance(definition, f"node_{place}")
        for given in definition.getInputs():
            node.addInput(given.getName(), "float").setValue(0.5)
        for output in definition.getOutputs():
            number += 1
            added = graph.addNode("add", f"sum_{number}", "float")
            one = added.addInput("in1", "float")
            one.setNodeName(node.getName())
            if len(definition.getOutputs()) > 1:
                one.setOutputString(output.getName())
            if total:
                added.addInput("in2", "float").setNodeName(total.getName())
            else:
                added.addInput("in2", "float").setValue(0.0)
            total = added
    result = graph.addOutput("sum_output", "float")
    result.setNodeName(total.getName())
    return result


folder = pathlib.Path(sys.argv[1])
search, library = mx.getDefaultDataSearchPath(), mx.createDocument()
mx.loadLibraries(mx.getDefaultDataLibraryFolders(), search, library)
together = mx.createDocument()
together.setDataLibrary(library)
names = []
for path in sorted(folder.glob("*.mtlx"), key=lambda path: int(path.stem)):
    document = loaded(path, library)
    names += [definition.getName() for definition in document.getNodeDefs()
              if library.getNodeDef(definition.getName()) is None]
    together.importLibrary(document)
output = instances(together, [together.getNodeDef(name) for name in names])
validate(together, "the nodes of all documents")
for language, generator in GENERATORS.items():
    generator = generator.create()
    context = shader.GenContext(generator)
    context.registerSourceCodeSearchPath(search)
    code = generator.generate("values", output, context).getSourceCode(shader.PIXEL_STAGE)
    if language == "osl":
        # Whoever compiles it elsewhere does not know the libraries' folder.
        header = search.find("libraries/stdlib/genosl/include/mx_funcs.h").asString()
        code = code.replace('"mx_funcs.h"', f'"{header}"')
    (folder / f"pixel.{language}").write_text(code)
