// Khronos's own validator of glTF: prints what it says of the file.
const fs = require("fs");
const validator = require(process.argv[2] + "/node_modules/gltf-validator");
validator
    .validateBytes(new Uint8Array(fs.readFileSync(process.argv[3])))
    .then((report) => console.log(JSON.stringify(report)));
