; The installer for Windows: for one user, without rights of an administrator. `package/windows` gives VERSION, FROM and TO.
; As the program: for 64 bits. The other stub would not run under a Wine of 64 bits alone.
Target amd64-unicode
Unicode true
!include "MUI2.nsh"
Name "Vitriol ${VERSION}"
OutFile "${TO}"
RequestExecutionLevel user
InstallDir "$LOCALAPPDATA\Programs\Vitriol"
SetCompressor /SOLID lzma

!insertmacro MUI_PAGE_WELCOME
!insertmacro MUI_PAGE_LICENSE "${FROM}\licences\LICENSE-MIT"
!insertmacro MUI_PAGE_DIRECTORY
!insertmacro MUI_PAGE_INSTFILES
!insertmacro MUI_UNPAGE_CONFIRM
!insertmacro MUI_UNPAGE_INSTFILES
!insertmacro MUI_LANGUAGE "English"

!define UNINSTALL "Software\Microsoft\Windows\CurrentVersion\Uninstall\Vitriol"

Section
    SetOutPath "$INSTDIR"
    File "${FROM}\vitriol.exe"
    File "${FROM}\README.md"
    File "${FROM}\CHANGELOG.md"
    SetOutPath "$INSTDIR\licences"
    File "${FROM}\licences\*.*"
    SetOutPath "$INSTDIR"
    WriteUninstaller "$INSTDIR\uninstall.exe"

    ; The console stays open behind a session, so that what is missing can be read.
    CreateDirectory "$SMPROGRAMS\Vitriol"
    CreateShortcut "$SMPROGRAMS\Vitriol\Vitriol.lnk" "$SYSDIR\cmd.exe" '/K ""$INSTDIR\vitriol.exe" desk"' "$INSTDIR\vitriol.exe" 0
    CreateShortcut "$SMPROGRAMS\Vitriol\In a headset.lnk" "$SYSDIR\cmd.exe" '/K ""$INSTDIR\vitriol.exe" vr"' "$INSTDIR\vitriol.exe" 0
    CreateShortcut "$SMPROGRAMS\Vitriol\What this computer lacks.lnk" "$SYSDIR\cmd.exe" '/K ""$INSTDIR\vitriol.exe" doctor"' "$INSTDIR\vitriol.exe" 0
    CreateShortcut "$SMPROGRAMS\Vitriol\Read me.lnk" "$INSTDIR\README.md"

    WriteRegStr HKCU "${UNINSTALL}" "DisplayName" "Vitriol"
    WriteRegStr HKCU "${UNINSTALL}" "DisplayVersion" "${VERSION}"
    WriteRegStr HKCU "${UNINSTALL}" "Publisher" "The Vitriol developers"
    WriteRegStr HKCU "${UNINSTALL}" "UninstallString" '"$INSTDIR\uninstall.exe"'
    WriteRegDWORD HKCU "${UNINSTALL}" "NoModify" 1
    WriteRegDWORD HKCU "${UNINSTALL}" "NoRepair" 1
SectionEnd

Section "Uninstall"
    Delete "$INSTDIR\vitriol.exe"
    Delete "$INSTDIR\README.md"
    Delete "$INSTDIR\CHANGELOG.md"
    Delete "$INSTDIR\licences\LICENSE-MIT"
    Delete "$INSTDIR\licences\LICENSE-APACHE"
    Delete "$INSTDIR\licences\C-CODE.md"
    Delete "$INSTDIR\licences\CRATES.md"
    RMDir "$INSTDIR\licences"
    Delete "$INSTDIR\uninstall.exe"
    ; What a user keeps there stays.
    RMDir "$INSTDIR"
    Delete "$SMPROGRAMS\Vitriol\*.lnk"
    RMDir "$SMPROGRAMS\Vitriol"
    DeleteRegKey HKCU "${UNINSTALL}"
SectionEnd
