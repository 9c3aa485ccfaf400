"""dxc.py SOURCE OUTPUT ARGUMENTS...: compiles HLSL by libdxcompiler.so of `install`.

Its messages go to stderr; the exit status is 1 if it refuses the source."""
import ctypes, os, pathlib, sys, uuid

CLSID_COMPILER = "73e22d93-e6ce-47f3-b5bf-f0664f39c1b0"
IID_COMPILER3 = "228b4687-5a6a-4730-900c-9702b2203f54"
IID_RESULT = "58346cda-dde7-4497-9461-6f87af5e0659"
IID_BLOB = "8ba5fb08-5195-40e2-ac58-0d989c3a0102"
# Before a COM interface's own methods: QueryInterface, AddRef, Release, and, outside Windows, the
# two places of IUnknown's virtual destructor.
OF_UNKNOWN = 5
OUT_OBJECT, OUT_ERRORS, CP_UTF8 = 1, 2, 65001
# Only Windows has the signer, and nothing here asks for signed code.
UNSIGNED = "warning: DXIL.dll not found.  Resulting DXIL will not be signed for use in release environments."


class Buffer(ctypes.Structure):
    _fields_ = [("data", ctypes.c_char_p), ("size", ctypes.c_size_t), ("encoding", ctypes.c_uint32)]


def guid(text):
    return ctypes.create_string_buffer(uuid.UUID(text).bytes_le, 16)


def call(interface, method, *arguments, returns=ctypes.c_int32):
    """Calls a method by its place in dxcapi.h's interface."""
    table = ctypes.cast(interface, ctypes.POINTER(ctypes.POINTER(ctypes.c_void_p)))[0]
    types = [type(a) if isinstance(a, ctypes._SimpleCData) else ctypes.c_void_p for a in arguments]
    function = ctypes.CFUNCTYPE(returns, ctypes.c_void_p, *types)(table[OF_UNKNOWN + method])
    result = function(interface, *arguments)
    if returns is ctypes.c_int32 and result < 0:
        raise OSError(f"method {method}: {result & 0xFFFFFFFF:#x}")
    return result


def output(result, kind):
    if not call(result, 3, ctypes.c_uint32(kind), returns=ctypes.c_uint32):  # HasOutput
        return b""
    blob = ctypes.c_void_p()
    call(result, 4, ctypes.c_uint32(kind), guid(IID_BLOB), ctypes.byref(blob), None)  # GetOutput
    if not blob:
        return b""
    data, size = call(blob, 0, returns=ctypes.c_void_p), call(blob, 1, returns=ctypes.c_size_t)
    return ctypes.string_at(data, size) if size else b""


def compiled(source, arguments):
    """Whether the compiler took the source, the code, and what it said."""
    default = pathlib.Path(__file__).resolve().parents[2] / "target/tools"
    library = ctypes.CDLL(str(pathlib.Path(os.environ.get("LGP_TOOLS", default), "libdxcompiler.so")))
    compiler, result, status = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_int32()
    ids = guid(CLSID_COMPILER), guid(IID_COMPILER3)
    if library.DxcCreateInstance(*ids, ctypes.byref(compiler)) != 0:
        raise OSError("there is no IDxcCompiler3")
    text = pathlib.Path(source).read_bytes()
    strings = (ctypes.c_wchar_p * (len(arguments) + 1))(source, *arguments)
    call(compiler, 0, ctypes.byref(Buffer(text, len(text), CP_UTF8)), strings,  # Compile
         ctypes.c_uint32(len(strings)), None, guid(IID_RESULT), ctypes.byref(result))
    call(result, 0, ctypes.byref(status))  # GetStatus
    said = output(result, OUT_ERRORS).rstrip(b"\0").decode().replace(UNSIGNED, "").strip()
    return status.value >= 0, output(result, OUT_OBJECT), said


if __name__ == "__main__":
    took, code, said = compiled(sys.argv[1], sys.argv[3:])
    print(said, file=sys.stderr)
    if not took:
        sys.exit(1)
    pathlib.Path(sys.argv[2]).write_bytes(code)
