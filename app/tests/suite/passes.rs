//! `vitriol picture --passes`: a file for each pass, and what it shows.

use std::collections::HashSet;
use std::path::Path;

use clap::Parser;
use image::{GrayImage, RgbaImage};
use vitriol::cli::{Cli, Command};
use vitriol::command::picture;
use vitriol_run::{Failure, Format, Setup, on_device};
use vitriol_sim::scene::Scene;
use vitriol_tests::gpu;

/// Width and height of the pictures.
const SIZE: (u32, u32) = (320, 180);

/// A beaker on a bench with few particles.
fn scene() -> Scene {
    let mut scene = Scene::builtin("beaker").unwrap();
    scene.scale.spacing *= 2.0;
    scene.solver.substeps = 4;
    scene
}

/// A picture of the small beaker into `folder`, with its passes.
fn take(folder: &Path, name: &str, more: &[&str]) -> Result<(), Failure> {
    let (file, passes) = (folder.join(name), folder.join("passes"));
    let size = format!("{}x{}", SIZE.0, SIZE.1);
    let named = ["hands-off", "--scene", "beaker", "--at", "0.05"];
    let paths = [&file, &passes].map(|path| path.to_str().unwrap());
    let options = ["-o", paths[0], "--passes", paths[1], "--size", &size];
    let arguments = ["vitriol", "picture"].iter().chain(&named);
    let arguments = arguments.chain(&options).chain(more);
    let Command::Picture(args) = Cli::parse_from(arguments).command else {
        panic!("picture is parsed as another command");
    };
    let device = gpu::device();
    picture::run(&args, Format::Json, |setup| {
        let coarse = Setup {
            scene: &scene(),
            colours: setup.colours.clone(),
            shaders: setup.shaders.clone(),
            ..*setup
        };
        on_device(&device, &coarse)
    })
}

fn open(path: &Path) -> RgbaImage {
    image::open(path).unwrap().to_rgba8()
}

/// Where there is liquid: elsewhere a pass's picture is as in its upper left corner.
fn silhouette(picture: &RgbaImage) -> GrayImage {
    let nothing = picture.get_pixel(0, 0);
    GrayImage::from_fn(picture.width(), picture.height(), |x, y| {
        [u8::from(picture.get_pixel(x, y) != nothing)].into()
    })
}

/// Whether every pixel of `a` has one of `b` within two pixels along rows and columns.
fn is_near(a: &GrayImage, b: &GrayImage) -> bool {
    let near = |x: u32, y: u32| {
        let row = |y| (x.saturating_sub(2)..=x + 2).map(move |x| (x, y));
        (y.saturating_sub(2)..=y + 2)
            .flat_map(row)
            .any(|(x, y)| b.get_pixel_checked(x, y).is_some_and(|pixel| pixel[0] == 1))
    };
    a.enumerate_pixels()
        .all(|(x, y, pixel)| pixel[0] == 0 || near(x, y))
}

#[test]
fn each_pass_leaves_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    take(folder.path(), "picture.png", &[]).unwrap();
    let passes = folder.path().join("passes");
    let mut names: Vec<String> = std::fs::read_dir(&passes)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let expected = [
        "1-tiles.png",
        "2-liquid-depth.png",
        "3-liquid-depth-normals.png",
        "4-liquid-thickness.png",
        "5-liquid-filter.png",
        "6-liquid-filter-normals.png",
        "7-picture.png",
        "8-finish.png",
    ];
    assert_eq!(names, expected);
    let pictures = expected.map(|name| open(&passes.join(name)));
    for (name, picture) in expected.iter().zip(&pictures) {
        assert_eq!(picture.dimensions(), SIZE, "{name}");
        let colours: HashSet<_> = picture.pixels().collect();
        assert!(colours.len() > 16, "{name}: {} colours", colours.len());
    }
    let [
        tiles,
        depth,
        depth_normals,
        thickness,
        filter,
        filter_normals,
        drawn,
        finish,
    ] = &pictures;
    assert_ne!(depth, filter);
    assert_ne!(depth_normals, filter_normals);
    assert_ne!(drawn, finish);
    // Water has no legend: the last pass is the picture.
    assert_eq!(*finish, open(&folder.path().join("picture.png")));

    let [depth, thickness] = [depth, thickness].map(silhouette);
    let liquid = depth.pixels().filter(|pixel| pixel[0] == 1).count();
    assert!(liquid > 1000, "{liquid} pixels of liquid");
    // Thickness is summed for blocks of two by two pixels, each by a ray of its own: an ellipsoid that
    // a pixel's ray meets is met by that of a block beside it, and the other way round.
    assert!(is_near(&depth, &thickness) && is_near(&thickness, &depth));
    // Every pixel of liquid lies in a tile that is marked, off the lines between tiles.
    for (x, y, pixel) in depth.enumerate_pixels() {
        if pixel[0] == 1 && x % 32 != 0 && y % 32 != 0 {
            assert_ne!(tiles.get_pixel(x, y), finish.get_pixel(x, y), "({x}, {y})");
        }
    }
}

#[test]
fn passes_are_of_liquid_and_replace_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, more: &[&str]| {
        let failure = take(folder.path(), name, more).unwrap_err();
        assert!(matches!(failure, Failure::Input(_)), "{failure}");
        assert!(!folder.path().join(name).exists());
        failure.to_string()
    };
    let message = refused("speed.png", &["--colour", "speed"]);
    assert!(message.contains("--passes"), "{message}");
    std::fs::create_dir(folder.path().join("passes")).unwrap();
    let message = refused("again.png", &[]);
    assert!(message.contains("passes: exists"), "{message}");
}
